// SPDX-License-Identifier: Apache-2.0
#include "fit/aligned_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/alignment/alignment.h"
#include "obvid/geom/internal/circle.h"
#include "obvid/series/internal/scatter.h"

namespace obvid::pipeline_detail {
namespace {

/// More points are searched with every second one, third one ...: the search takes the square of
/// their number.
constexpr std::size_t kMostSearched = 500;
constexpr std::size_t kFewestOnPiece = 4;  ///< points
/// Of the tolerance: what is searched within at least, and the least scatter.
constexpr double kLeastShare = 0.2, kLeastScatter = 0.05;
/// Offsets from curves that are not what the points mean have their errors on top: of the scatter,
/// the most that a root of the mean square may be.
constexpr double kMostScatter = 1.3;
/// Of the bound of the scatter, what is searched within first; and that bound, in deviations, where
/// points show none.
constexpr double kRoom = 1.1, kRoughBound = 4.0;
/// Times that the search may ask whether it goes on, for each point: lines and arcs that are there
/// take some 50.
constexpr int kMostAskedEach = 150;
/// Between two times, for each point, in the units of `Watch::spend`.
constexpr double kWorkOfPoint = 1.4;
/// Of the tolerances, what a circle through three points of many may be off the others at most
/// where they lie within them of one circle: their own errors, magnified between and beside.
constexpr double kThroughThree = 4.0;

class AlignedLines {
 public:
  AlignedLines(const MeasuredSeries& series, std::optional<double> scatter, Watch& watch)
      : s_(series), scatter_(scatter), watch_(watch) {
    step_ = (s_.points.size() + kMostSearched - 1) / kMostSearched;
    for (std::size_t i = 0; i < s_.points.size(); i += step_) points_.push_back(s_.points[i]);
  }

  std::vector<MeantPiece> run() {
    const auto own = middle_deviation(points_), scatter = own ? own : scatter_;
    if (!scatter) return {};
    const auto known = scatter_of(points_);
    const double bound = kRoom * (known ? known->bound : kRoughBound * *scatter);
    std::vector<double> all, narrow;
    for (std::size_t i = 0; i < s_.points.size(); i += step_) all.push_back(s_.reach[i]);
    double least = *std::max_element(all.begin(), all.end());
    for (const double reach : all) least = reach > 0.0 ? std::min(least, reach) : least;
    if (!(least > 0.0)) return {};
    for (double& reach : all) {
      if (!(reach > 0.0)) reach = least;  // corners, which stay where they are
      narrow.push_back(std::min(reach, std::max(bound, kLeastShare * reach)));
    }
    const double most = kMostScatter * std::max(*scatter, kLeastScatter * least);
    auto out = within(narrow, most);
    if (out.empty() && narrow != all && !took_too_long_) out = within(all, most);
    return out;
  }

 private:
  std::vector<MeantPiece> within(const std::vector<double>& tolerance, double most) {
    if (stretches(tolerance) * kFewestOnPiece > points_.size()) return {};
    const int most_asked = kMostAskedEach * static_cast<int>(points_.size());
    int asked = 0;
    RunContext run;
    const double work = kWorkOfPoint * static_cast<double>(points_.size());
    run.cancelled = [&] { return ++asked > most_asked || !watch_.spend(work); };
    AlignmentOptions options;
    options.closed = s_.closed;
    const auto found = fit_alignment(points_, tolerance, options, run);
    took_too_long_ = asked > most_asked;
    if (!found || (s_.closed && found->elements.size() < 2) || !(found->rms <= most)) return {};
    std::vector<MeantPiece> out;
    for (const AlignmentElement& e : found->elements) {
      if (e.kind != AlignmentKind::kLine && e.kind != AlignmentKind::kArc) return {};
      if (const auto piece = piece_of(e, *found)) out.push_back(*piece);
    }
    return out;
  }

  /// The fewest of consecutive points that may lie on one line or arc each: where the points mean
  /// lines and arcs there are no more of these.
  [[nodiscard]] std::size_t stretches(const std::vector<double>& tolerance) const {
    std::size_t count = 0;
    for (std::size_t first = 0; first < points_.size(); ++count) {
      std::size_t last = first;
      while (last + 1 < points_.size() && may_be_one(tolerance, first, last + 1)) ++last;
      first = last + 1;
    }
    return count;
  }

  [[nodiscard]] bool may_be_one(const std::vector<double>& tolerance, std::size_t first,
                                std::size_t last) const {
    if (last < first + 3) return true;
    const Vec2 begin = points_[first], end = points_[last];
    const auto middle = std::min_element(points_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                                         points_.begin() + static_cast<std::ptrdiff_t>(last),
                                         [&](const Vec2 a, const Vec2 b) {
                                           return std::abs(norm(a - begin) - norm(a - end)) <
                                                  std::abs(norm(b - begin) - norm(b - end));
                                         });
    const Vec2 one = *middle - begin, two = end - begin;
    const double area = cross(one, two);
    const Vec2 inward = -left_normal(dot(one, one) * two - dot(two, two) * one);
    const double size = norm(inward);
    if (!(size > 0.0)) return true;  // places fall together
    const double kappa = 2.0 * std::abs(area) / size;
    const Vec2 tangent = (std::copysign(1.0, area) / size) * -left_normal(inward);
    for (std::size_t i = first; i <= last; ++i) {
      const double off = distance_beside_circle(begin, tangent, kappa, points_[i]);
      if (!(std::abs(off) <= kThroughThree * tolerance[i])) return false;
    }
    return true;
  }

  /// With the points whose feet it has.
  [[nodiscard]] std::optional<MeantPiece> piece_of(const AlignmentElement& e,
                                                   const Alignment& all) const {
    const double begin = all.elements.front().station;
    std::vector<std::size_t> on;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      double s = all.deviations[i].station;
      if (s_.closed && s >= begin + all.length) s -= all.length;
      if (s >= e.station && s <= e.station + e.length) on.push_back(i);
    }
    // around the seam of a loop: from behind the gap on
    std::size_t seam = 0;
    for (std::size_t k = 1; s_.closed && k < on.size(); ++k) {
      if (on.front() == 0 && on.back() + 1 == points_.size() && on[k] > on[k - 1] + 1) seam = k;
    }
    if ((on.size() - std::min(on.size(), std::size_t{1})) * step_ + 1 < kFewestOnPiece) {
      return std::nullopt;
    }
    MeantPiece out;
    out.first = on[seam] * step_;
    out.last = on[(seam + on.size() - 1) % on.size()] * step_;
    if (seam > 0) out.last += s_.points.size();
    const double half = 0.5 * e.length, turn = 0.5 * e.start.kappa * half;
    const double chord = turn == 0.0 ? half : half * std::sin(turn) / turn;
    out.middle = {e.start.point + chord * unit_at(e.start.theta + turn), e.start.theta + 2.0 * turn,
                  e.kind == AlignmentKind::kLine ? 0.0 : e.start.kappa};
    return out;
  }

  const MeasuredSeries& s_;
  std::optional<double> scatter_;
  Watch& watch_;
  std::vector<Vec2> points_;
  std::size_t step_ = 1;
  bool took_too_long_ = false;
};

}  // namespace

std::vector<MeantPiece> aligned_lines(const MeasuredSeries& series, std::optional<double> scatter,
                                      Watch& watch) {
  return AlignedLines(series, scatter, watch).run();
}

}  // namespace obvid::pipeline_detail
