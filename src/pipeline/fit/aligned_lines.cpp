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
/// And such errors go on from point to point: half the mean square of the differences of neighbours
/// is that of all where there are none. Of that the least, and of fewer points, where chance makes
/// it less, what lies so many standard deviations below.
constexpr double kLeastApart = 0.69, kDeviationsApart = 4.0;
/// Points that no element reaches are left out, and the search begins anew, so many times.
constexpr std::size_t kMostLeftOut = 3;
/// Of the bound of the scatter, what is searched within first; and that bound, in deviations, where
/// points show none.
constexpr double kRoom = 1.1, kRoughBound = 4.0;
/// Times that the search may ask whether it goes on, for each point: lines and arcs that are there
/// take some 50.
constexpr int kMostAskedEach = 80;
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
      if (!(reach > 0.0)) reach = least;  // points that stay where they are
      narrow.push_back(std::min(reach, std::max(bound, kLeastShare * reach)));
    }
    const double most = kMostScatter * std::max(*scatter, kLeastScatter * least);
    auto out = within(narrow, most);
    if (out.empty() && narrow != all && !took_too_long_) out = within(all, most);
    return out;
  }

 private:
  /// Lines and arcs alone. A point that none of them reaches is left out: it costs its own element.
  std::vector<MeantPiece> within(const std::vector<double>& tolerance, double most) {
    if (stretches(tolerance) * kFewestOnPiece > points_.size()) return {};
    const int most_asked = kMostAskedEach * static_cast<int>(points_.size());
    int asked = 0;
    RunContext run;
    const double work = kWorkOfPoint * static_cast<double>(points_.size());
    run.cancelled = [&] { return ++asked > most_asked || !watch_.spend(work); };
    AlignmentOptions options;
    options.closed = s_.closed;
    options.without_transitions = true;
    std::vector<Vec2> points;
    std::vector<double> allowed;
    place_.clear();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      // corners at the ends have no say: what lies between them meets there afterwards
      const bool end = !s_.closed && (i == 0 || i + 1 == points_.size());
      if (end && !(s_.reach[i * step_] > 0.0) && points_.size() > kFewestOnPiece + 2) continue;
      points.push_back(points_[i]);
      allowed.push_back(tolerance[i]);
      place_.push_back(i);
    }
    auto found = fit_alignment(points, allowed, options, run);
    for (std::size_t k = 0; k < kMostLeftOut && !found; ++k) {
      const std::ptrdiff_t bad = found.error().index;
      if (found.error().code != ErrorCode::kNoSpiral || bad <= 0) break;
      if (static_cast<std::size_t>(bad) + 1 >= points.size()) break;
      points.erase(points.begin() + bad);
      allowed.erase(allowed.begin() + bad);
      place_.erase(place_.begin() + bad);
      found = fit_alignment(points, allowed, options, run);
    }
    took_too_long_ = asked > most_asked;
    if (!found || (s_.closed && found->elements.size() < 2) || !is_all(*found, most)) return {};
    std::vector<MeantPiece> out;
    for (const AlignmentElement& e : found->elements) add_pieces(e, *found, out);
    return out;
  }

  /// Whether the points are off by their scatter and no more.
  [[nodiscard]] static bool is_all(const Alignment& found, double most) {
    const auto& all = found.deviations;
    double squares = 0.0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const double step = all[i].offset - all[i - 1].offset;
      squares += step * step;
    }
    const double count = static_cast<double>(all.size());
    const double apart = std::sqrt(0.5 * squares / (count - 1.0));
    if (!(found.rms <= std::max(most, kMostScatter * apart))) return false;
    const double least = std::min(kLeastApart, 1.0 - kDeviationsApart / std::sqrt(count));
    return apart * apart >= least * found.rms * found.rms;
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

  /// With the points whose feet it has; in parts where one between was left out.
  void add_pieces(const AlignmentElement& e, const Alignment& all,
                  std::vector<MeantPiece>& out) const {
    const double begin = all.elements.front().station;
    const auto station = [&](std::size_t i) {
      const double s = all.deviations[i].station;
      return s_.closed && s >= begin + all.length ? s - all.length : s;
    };
    std::vector<std::size_t> on;
    for (std::size_t i = 0; i < place_.size(); ++i) {
      if (station(i) >= e.station && station(i) <= e.station + e.length) on.push_back(i);
    }
    // around the seam of a loop: from behind the gap on
    std::size_t seam = 0;
    for (std::size_t k = 1; s_.closed && k < on.size(); ++k) {
      if (on.front() == 0 && on.back() + 1 == place_.size() && on[k] > on[k - 1] + 1) seam = k;
    }
    std::rotate(on.begin(), on.begin() + static_cast<std::ptrdiff_t>(seam), on.end());
    for (std::size_t first = 0, last = 0; first < on.size(); first = last + 1) {
      last = first;
      while (last + 1 < on.size() && !is_gap(on[last], on[last + 1])) ++last;
      if ((last - first) * step_ + 1 < kFewestOnPiece) continue;
      MeantPiece piece;
      piece.first = place_[on[first]] * step_;
      piece.last = place_[on[last]] * step_;
      if (piece.last < piece.first) piece.last += s_.points.size();
      const double s = 0.5 * (station(on[first]) + station(on[last])) - e.station;
      const double turn = 0.5 * e.start.kappa * s;
      const double chord = turn == 0.0 ? s : s * std::sin(turn) / turn;
      piece.middle = {e.start.point + chord * unit_at(e.start.theta + turn),
                      e.start.theta + 2.0 * turn,
                      e.kind == AlignmentKind::kLine ? 0.0 : e.start.kappa};
      out.push_back(piece);
    }
  }

  /// Whether a point was left out between two that were searched.
  [[nodiscard]] bool is_gap(std::size_t before, std::size_t after) const {
    const std::size_t n = points_.size();
    return (place_[after] + n - place_[before]) % n >
           (after + place_.size() - before) % place_.size();
  }

  const MeasuredSeries& s_;
  std::optional<double> scatter_;
  Watch& watch_;
  std::vector<Vec2> points_;
  std::vector<std::size_t> place_;  ///< of the points that are searched, among all
  std::size_t step_ = 1;
  bool took_too_long_ = false;
};

}  // namespace

std::vector<MeantPiece> aligned_lines(const MeasuredSeries& series, std::optional<double> scatter,
                                      Watch& watch) {
  return AlignedLines(series, scatter, watch).run();
}

}  // namespace obvid::pipeline_detail
