// SPDX-License-Identifier: Apache-2.0
#include "fit/corners_between.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace obvid::pipeline_detail {
namespace {

/// Points that establish a line and an arc: one more than lie on any with these errors, and three.
constexpr std::size_t kFewestOfLine = 4, kFewestOfArc = 6;
/// Points on each side beyond which nobody asks whether one line or arc has all of them: one that
/// has so many is no corner.
constexpr std::size_t kMostAcross = 16;
/// Where one line or arc has this many points on each side there is no telling that the curve
/// breaks; more of them ask for so many times as many on a side, and that the points nearest to the
/// gap turn there by this part of what all of them do: along a curve they turn the less the fewer.
constexpr std::size_t kAlways = 2, kSideOfAcross = 3;
constexpr double kTurnNear = 0.7;
/// An arc takes the place of a line that reaches half as far again, and this many points more.
constexpr std::size_t kArcGain = 3;
/// What bends away from a line or arc far from the corner has no say in where the corner lies: of
/// the points, those in the nearer three quarters count.
constexpr std::size_t kCounted = 3, kOf = 4;
/// A corner that was found at a point stays there where the place lies within this part of its
/// tolerance: the whole lines and arcs beside may meet a little farther off.
constexpr double kStays = 0.75;
/// A corner lies no farther beyond a point than so many of the longest chord beside it.
constexpr double kMostBeyond = 2.0;

/// A line or arc along points that end, or begin, beside a gap.
struct Flank {
  Shape shape;
  std::optional<Shape> near;  ///< along the nearer half of its points
  std::size_t points = 0;
  bool arc = false;
};

struct MetCorner {
  std::size_t gap = 0;  ///< behind this point
  Vec2 corner;
  double beyond = 0.0;     ///< how far the two points beside lie past the corner
  std::size_t points = 0;  ///< of the shorter side
};

class CornersBetween {
 public:
  CornersBetween(Prepared& series, double angle) : s_(series), angle_(angle) {
    const SplitSeries& split = s_.split;
    corner_.resize(s_.points.size(), false);
    for (const Section& one : split.sections) {
      if (!split.smooth_loop && (s_.closed || one.first > 0)) {
        corner_[split.point_at(one.first)] = true;
      }
    }
  }

  void run() {
    std::vector<MetCorner> all;
    const std::size_t n = s_.points.size();
    for (std::size_t gap = 0; gap + (s_.closed ? 0 : 1) < n; ++gap) {
      if (const auto one = candidate(gap)) all.push_back(*one);
    }
    std::stable_sort(all.begin(), all.end(), [](const MetCorner& a, const MetCorner& b) {
      return a.beyond != b.beyond ? a.beyond < b.beyond : a.points > b.points;
    });
    std::vector<MetCorner> chosen;
    for (const MetCorner& one : all) {
      const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const MetCorner& other) {
        const std::size_t on = (one.gap + n - other.gap) % n;
        return std::min(on, n - on) < kFewestOfLine;
      });
      if (!near) chosen.push_back(one);
    }
    std::sort(chosen.begin(), chosen.end(),
              [](const MetCorner& a, const MetCorner& b) { return a.gap < b.gap; });
    put(chosen);
  }

 private:
  [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % s_.points.size(); }

  /// Where the user said something, or a point may not move, nothing is looked for.
  [[nodiscard]] bool is_free(std::size_t i) const {
    const bool given = !s_.fixed.empty() && (s_.fixed[i].says_how() || s_.fixed[i].corner);
    return !given && s_.tolerance[i] > 0.0;
  }

  /// Points that go on from one, it included, as far as they are free, `most` of them.
  [[nodiscard]] std::size_t room(std::size_t from, bool forward, std::size_t most) const {
    const std::size_t n = s_.points.size();
    std::size_t count = 0, i = from;
    while (count < std::min(most, n - 1) && is_free(i)) {
      ++count;
      if (!s_.closed && i == (forward ? n - 1 : 0)) break;
      i = forward ? next(i) : (i + n - 1) % n;
    }
    return count;
  }

  /// Consecutive points from one on.
  [[nodiscard]] ShapePoints points_from(std::size_t first, std::size_t count) const {
    ShapePoints out;
    for (std::size_t k = 0, i = first; k < count; ++k, i = next(i)) {
      out.at.push_back(s_.points[i]);
      out.reach.push_back(s_.tolerance[i]);
    }
    return out;
  }

  /// Of points that end at `end`, or begin there.
  [[nodiscard]] std::optional<Shape> shape_at(std::size_t end, bool forward, std::size_t count,
                                              bool arc) const {
    const std::size_t n = s_.points.size();
    return shape_within(points_from(forward ? end : (end + n + 1 - count) % n, count), arc);
  }

  /// Whether one line or arc has so many points on both sides of a gap.
  [[nodiscard]] bool is_one_across(std::size_t gap, std::size_t count) const {
    const std::size_t n = s_.points.size();
    const std::size_t before = std::min(count, room(gap, false, count));
    const std::size_t after = std::min({count, room(next(gap), true, count), n - before});
    const ShapePoints points = points_from((gap + n + 1 - before) % n, before + after);
    if (points.at.size() < kFewestOfLine) return true;
    if (are_near_circle_of_squares(points.at, points.reach)) return true;  // at once, most gaps
    return shape_within(points, false) || shape_within(points, true);
  }

  /// The most points on each side that one line or arc has.
  [[nodiscard]] std::size_t across(std::size_t gap) const {
    std::size_t most = kAlways;  // they may lie on a circle whatever they do
    while (most < kMostAcross && is_one_across(gap, most + 1)) ++most;
    return most;
  }

  /// The line or arc with the most points that end, or begin, beside a gap.
  [[nodiscard]] std::optional<Flank> flank(std::size_t end, bool forward) const {
    const std::size_t most = room(end, forward, s_.points.size());
    const std::size_t line = longest(end, forward, most, false);
    const std::size_t arc = longest(end, forward, most, true);
    Flank out;
    out.arc = arc >= kFewestOfArc && arc > line + std::max(kArcGain, line / 2);
    out.points = out.arc ? arc : line;
    if (out.points < kFewestOfLine) return std::nullopt;
    const std::size_t fewest = out.arc ? kFewestOfArc : kFewestOfLine;
    const std::size_t counted = std::max(fewest, out.points * kCounted / kOf);
    auto shape = shape_at(end, forward, counted, out.arc);
    if (!shape) shape = shape_at(end, forward, out.points, out.arc);
    if (!shape) return std::nullopt;
    out.shape = *shape;
    out.near = shape_at(end, forward, std::max(fewest, out.points / 2), out.arc);
    return out;
  }

  [[nodiscard]] std::size_t longest(std::size_t end, bool forward, std::size_t most,
                                    bool arc) const {
    std::size_t good = arc ? kFewestOfArc : kFewestOfLine;
    if (most < good || !shape_at(end, forward, good, arc)) return 0;
    std::size_t bad = most + 1;
    for (std::size_t count = 2 * good; count < bad; count *= 2) {
      if (shape_at(end, forward, count, arc)) {
        good = count;
      } else {
        bad = count;
      }
    }
    while (bad > good + 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (shape_at(end, forward, middle, arc) ? good : bad) = middle;
    }
    return good;
  }

  [[nodiscard]] bool has_side(std::size_t end, bool forward, std::size_t count) const {
    const std::size_t arc = std::max(count, kFewestOfArc), most = room(end, forward, arc);
    return (most >= count && shape_at(end, forward, count, false)) ||
           (most >= arc && shape_at(end, forward, arc, true));
  }

  [[nodiscard]] std::optional<MetCorner> candidate(std::size_t gap) const {
    const std::size_t after = next(gap);
    if (!is_free(gap) || !is_free(after) || s_.taken_back.is_unbroken(gap)) return std::nullopt;
    if (is_one_across(gap, kMostAcross)) return std::nullopt;
    const std::size_t both = across(gap);
    const std::size_t fewest = both == kAlways ? kFewestOfLine : kSideOfAcross * both;
    if (!has_side(gap, false, fewest) || !has_side(after, true, fewest)) return std::nullopt;
    const auto a = flank(gap, false), b = flank(after, true);
    if (!a || !b || std::min(a->points, b->points) < fewest) return std::nullopt;
    if (both > kAlways && !turns_near(*a, *b, 0.5 * (s_.points[gap] + s_.points[after]))) {
      return std::nullopt;
    }
    return meets(gap, *a, *b);
  }

  /// How far the contour turns where both meet near a place, rad; nothing where they do not.
  static std::optional<double> turn_at(const Shape& a, const Shape& b, Vec2 near) {
    const auto corner = meeting(a, b, near);
    if (!corner) return std::nullopt;
    return std::abs(
        turn_between(a.theta + a.kappa * a.foot(*corner), b.theta + b.kappa * b.foot(*corner)));
  }

  static bool turns_near(const Flank& a, const Flank& b, Vec2 gap) {
    const auto whole = turn_at(a.shape, b.shape, gap);
    if (!whole || !a.near || !b.near) return false;
    const auto near = turn_at(*a.near, *b.near, gap);
    return near && *near >= kTurnNear * *whole;
  }

  [[nodiscard]] std::optional<MetCorner> meets(std::size_t gap, const Flank& a,
                                               const Flank& b) const {
    const std::size_t n = s_.points.size(), after = next(gap);
    const Vec2 p = s_.points[gap], q = s_.points[after];
    const auto corner = meeting(a.shape, b.shape, 0.5 * (p + q));
    if (!corner) return std::nullopt;
    double chord = norm(q - p);
    if (s_.closed || gap > 0) chord = std::max(chord, norm(p - s_.points[(gap + n - 1) % n]));
    if (s_.closed || after + 1 < n) chord = std::max(chord, norm(s_.points[next(after)] - q));
    if (!(std::max(norm(*corner - p), norm(*corner - q)) <= kMostBeyond * chord)) {
      return std::nullopt;
    }
    const double end_a = a.shape.foot(*corner), end_b = b.shape.foot(*corner);
    const double turn = std::abs(
        turn_between(a.shape.theta + a.shape.kappa * end_a, b.shape.theta + b.shape.kappa * end_b));
    const double reach = s_.tolerance[gap] + s_.tolerance[after];
    if (!(turn >= angle_) || !cannot_touch(a.shape, b.shape, turn, reach)) return std::nullopt;
    const PointsBeside beside{p, q, s_.tolerance[gap], s_.tolerance[after]};
    if (!lies_between(a.shape, b.shape, beside, *corner)) return std::nullopt;
    MetCorner out{gap, *corner, 0.0, std::min(a.points, b.points)};
    out.beyond = std::max(0.0, a.shape.foot(p) - end_a) + std::max(0.0, end_b - b.shape.foot(q));
    return out;
  }

  /// Two curves that meet at an angle have a tangent in common where one is moved by half of
  /// `turn^2 / (curvature of both)`: within the reaches the points may mean that.
  static bool cannot_touch(const Shape& a, const Shape& b, double turn, double reach) {
    const double apart = std::abs(a.kappa - b.kappa);
    return 0.5 * turn * turn > 2.0 * reach * apart;
  }

  [[nodiscard]] bool stays(std::size_t point, std::size_t other, Vec2 meet) const {
    if (!corner_[point] || corner_[other]) return false;
    return norm(s_.points[point] - meet) <= kStays * s_.tolerance[point];
  }

  /// Corners that were found at the points that a line or arc has beside the gap are none.
  void take_back(std::size_t from, bool forward) {
    const std::size_t n = s_.points.size();
    for (std::size_t k = room(from, forward, kFewestOfLine - 1), i = from; k > 0; --k) {
      if (corner_[i]) s_.reach[i] = s_.tolerance[i];
      corner_[i] = false;
      i = forward ? next(i) : (i + n - 1) % n;
    }
  }

  void put(const std::vector<MetCorner>& chosen) {
    const std::size_t n = s_.points.size();
    std::vector<Vec2> corners;
    for (const MetCorner& one : chosen) {
      const std::size_t p = one.gap, q = next(p);
      if (stays(p, q, one.corner) || stays(q, p, one.corner)) continue;
      take_back(p, false);
      take_back(q, true);
      s_.after.push_back(p);
      corners.push_back(one.corner);
    }
    if (corners.empty()) return;
    std::vector<std::size_t> order, cuts;
    for (std::size_t i = 0, k = 0; i < n; ++i) {
      if (corner_[i]) cuts.push_back(order.size());
      order.push_back(i);
      if (k == s_.after.size() || s_.after[k] != i) continue;
      cuts.push_back(order.size());
      order.push_back(n + k++);
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t p = s_.after[k], q = next(p);
      s_.points.push_back(corners[k]);
      s_.reach.push_back(0.0);
      s_.tolerance.push_back(std::max(s_.tolerance[p], s_.tolerance[q]));
      if (!s_.fixed.empty()) s_.fixed.emplace_back();
    }
    s_.split = split_sections(order.size(), cuts, s_.closed);
    for (std::size_t& place : s_.split.order) place = order[place];
  }

  Prepared& s_;
  double angle_;
  std::vector<bool> corner_;  ///< of each measured point
};

}  // namespace

bool lies_between(const Shape& a, const Shape& b, const PointsBeside& points, Vec2 corner) {
  const auto keeps = [&](bool past, Vec2 p, const Shape& other, double reach) {
    return !past || std::min(norm(p - corner), std::abs(other.off(p))) <= reach;
  };
  return keeps(a.foot(points.before) > a.foot(corner), points.before, b, points.reach_before) &&
         keeps(b.foot(points.after) < b.foot(corner), points.after, a, points.reach_after);
}

void add_corners_between(Prepared& series, double angle) {
  const bool none = !series.primitives || series.exact() || series.period || !series.kept.empty() ||
                    series.points.size() < 2 * kFewestOfLine;
  if (!none) CornersBetween(series, angle).run();
}

}  // namespace obvid::pipeline_detail
