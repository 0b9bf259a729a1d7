// SPDX-License-Identifier: Apache-2.0
#include "skin_breaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "obvid/core/internal/watch.h"

namespace obvid {
namespace {

constexpr std::size_t kBreakSamples = 16;  ///< steps of a span at which it is compared
constexpr double kShare = 0.1;             ///< of the change of curvature over a span
constexpr double kShareAtVertex = 1e-3;    ///< the same where the contour has a vertex in the span
constexpr double kKept = 1e-6;  ///< of the curvature: for circular stretches, which do not change

/// Halvings between two marks for the sake of points, and of curvature: where a contour's curvature
/// steps within the rounding of its joints, no spline follows it, and more breaks are in vain.
constexpr int kDeepest = 10;
constexpr int kDeepestForCurvature = 8;

enum class Following { kNot, kByPoints, kWhole };

/// Whether changes of curvature that run one way on the contour run that way on the spline.
class OneWay {
 public:
  explicit OneWay(double allowed) : allowed_(allowed) {}
  void add(double wanted, double found) {
    if (any_) {
      up_ = up_ && wanted >= last_wanted_;
      down_ = down_ && wanted <= last_wanted_;
      rise_ = std::max(rise_, found - last_found_);
      fall_ = std::max(fall_, last_found_ - found);
    }
    any_ = true;
    last_wanted_ = wanted;
    last_found_ = found;
  }
  [[nodiscard]] bool wanted() const { return up_ || down_; }
  [[nodiscard]] bool kept() const {
    return !((up_ && fall_ > allowed_) || (down_ && rise_ > allowed_));
  }

 private:
  double allowed_;
  bool any_ = false, up_ = true, down_ = true;
  double last_wanted_ = 0.0, last_found_ = 0.0, rise_ = 0.0, fall_ = 0.0;
};

/// How well one section is followed over [a, b].
Following following(const SectionCurve& section, double a, double b, double tolerance,
                    double size) {
  if (section.is_point()) return Following::kWhole;
  const double length = b - a;
  const std::array<Vec3, 6> piece = quintic(section.at(a), section.at(b), length);
  std::array<double, kBreakSamples + 1> wanted{}, found{};
  for (std::size_t k = 0; k <= kBreakSamples; ++k) {
    // from the middle on, where most spans that are too long show it
    const std::size_t i = (k + kBreakSamples / 2) % (kBreakSamples + 1);
    const double part = static_cast<double>(i) / kBreakSamples;
    const Hermite here = evaluate(piece, part, length), there = section.at(a + part * length);
    if (norm(here.point - there.point) > tolerance) return Following::kNot;
    wanted[i] = plane_curvature(there, section.frame());
    found[i] = plane_curvature(here, section.frame());
  }
  const auto [low, high] = std::minmax_element(wanted.begin(), wanted.end());
  const double largest = std::max({std::abs(*low), std::abs(*high), 1.0 / size});
  OneWay one_way(kKept * largest);
  double error = 0.0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    error = std::max(error, std::abs(found[i] - wanted[i]));
    one_way.add(wanted[i], found[i]);
  }
  const double share = one_way.wanted() ? kShare : kShareAtVertex;
  const bool near = error <= std::max(share * (*high - *low), kKept * largest);
  return near && one_way.kept() ? Following::kWhole : Following::kByPoints;
}

class Halving {
 public:
  Halving(const std::vector<SectionCurve>& sections, const std::vector<double>& marks,
          const BreakGoals& goals, Watch& watch)
      : sections_(sections), marks_(marks), goals_(goals), watch_(watch) {
    constexpr double kNoLength = 1e-300;  // units: below it nothing can be divided by
    for (const SectionCurve& section : sections) {
      size_.push_back(section.is_point() ? 1.0 : std::max(section.length_at(1.0).s, kNoLength));
    }
  }

  /// Breaks after `first` up to `last`, which are numbers of marks.
  bool between_marks(std::size_t first, std::size_t last) {
    if (worst(marks_[first], marks_[last], Following::kByPoints) == Following::kWhole) {
      breaks_.push_back(marks_[last]);
      return true;
    }
    if (last - first == 1) return between(marks_[first], marks_[last], kDeepest);
    const double middle = (marks_[first] + marks_[last]) / 2.0;
    const auto above =
        std::lower_bound(marks_.begin() + static_cast<std::ptrdiff_t>(first) + 1,
                         marks_.begin() + static_cast<std::ptrdiff_t>(last) - 1, middle);
    const auto cut = static_cast<std::size_t>(above - marks_.begin());
    return between_marks(first, cut) && between_marks(cut, last);
  }

  std::vector<double> breaks_ = {0.0};

 private:
  /// The section that was not followed last is asked first: it needs short spans. Ends where it is
  /// no better than `enough`: nobody asks how much worse it is.
  [[nodiscard]] Following worst(double a, double b, Following enough) {
    Following least = Following::kWhole;
    const std::size_t first = hardest_;
    for (std::size_t i = 0; i < sections_.size() && !watch_.cancelled(); ++i) {
      const std::size_t k = (first + i) % sections_.size();
      least = std::min(least, following(sections_[k], a, b, goals_.tolerance, size_[k]));
      if (least > enough) continue;
      hardest_ = k;
      break;
    }
    return least;
  }

  bool between(double a, double b, int depth) {
    if (watch_.cancelled()) return false;
    const bool in_vain = depth + kDeepestForCurvature <= kDeepest;
    const Following least = worst(a, b, in_vain ? Following::kNot : Following::kByPoints);
    if (least == Following::kWhole || (least == Following::kByPoints && in_vain)) {
      breaks_.push_back(b);
      return true;
    }
    if (depth == 0) return false;
    const double middle = (a + b) / 2.0;
    return between(a, middle, depth - 1) && between(middle, b, depth - 1);
  }

  const std::vector<SectionCurve>& sections_;
  const std::vector<double>& marks_;
  BreakGoals goals_;
  Watch& watch_;
  std::vector<double> size_;
  std::size_t hardest_ = 0;
};

}  // namespace

double plane_curvature(const Hermite& at, const Frame& frame) {
  const Vec2 d1{dot(at.d1, frame.x), dot(at.d1, frame.y)};
  const Vec2 d2{dot(at.d2, frame.x), dot(at.d2, frame.y)};
  const double speed = norm(d1);
  return speed > 0.0 ? cross(d1, d2) / (speed * speed * speed) : 0.0;
}

double curvature_rounding(const Hermite& at, double span, const SectionCurve& section) {
  // second derivatives are 5 * 4 differences p - 2 q + r of coordinates that were rounded
  constexpr double kOfDegree = 20.0 * 4.0;
  const double length = norm(at.d1) * span;
  if (!(length > 0.0)) return 0.0;
  return kOfDegree * std::numeric_limits<double>::epsilon() * section.largest_coordinate() /
         (length * length);
}

Result<std::vector<double>> breaks_for(const std::vector<SectionCurve>& sections,
                                       const std::vector<double>& marks, const BreakGoals& goals,
                                       const RunContext& run) {
  Watch watch(run);
  Halving halving(sections, marks, goals, watch);
  const bool followed = halving.between_marks(0, marks.size() - 1);
  if (watch.was_cancelled()) return fail(cancelled_error());
  if (!followed) {
    const double at = halving.breaks_.back();
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("the sections are not followed within {:g} at {:.1f} % of a stretch",
                             goals.tolerance, 100.0 * at))
        .hint("allow a larger tolerance")
        .value(goals.tolerance);
  }
  return halving.breaks_;
}

}  // namespace obvid
