// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/core/units.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid::region_detail {

/// How an arc goes from one tangent to the next.
enum class Turning {
  kShort,     ///< by less than half a turn, along its curvature
  kBack,      ///< hardly, and against its curvature: rounding
  kOverHalf,  ///< by more than half a turn, along its curvature
};

/// Both arcs of a boundary, its tangents seen from the chord. Headings lie less than half a turn
/// from the chord, so both turns together are the difference of those at its ends: that tells an
/// arc of nearly a whole turn from one that rounding turned back.
[[nodiscard]] inline std::array<Turning, 2> turnings(Vec2 start, Vec2 joint, Vec2 end,
                                                     double kappa_first, double kappa_second) {
  const bool first_along = cross(start, joint) * kappa_first >= 0.0,
             second_along = cross(joint, end) * kappa_second >= 0.0;
  if (first_along && second_along) return {Turning::kShort, Turning::kShort};
  const auto angle = [](Vec2 t) { return std::atan2(t.y, t.x); };
  const double alpha = angle(start), beta = angle(end), theta = angle(joint);
  // beside an inflection both arcs could turn once more: only what is no rounding makes them
  constexpr double kNoRounding = 1.0;  // rad
  const bool inflection = kappa_first * kappa_second < 0.0;
  double first = theta - alpha, second = beta - theta;
  const auto off = [](double turn, double kappa) {  // a line does not turn
    return kappa == 0.0 ? std::abs(turn) : std::max(0.0, -std::copysign(1.0, kappa) * turn);
  };
  const auto against = [&](double one, double other) {
    return std::max(off(one, kappa_first), off(other, kappa_second));
  };
  double least = against(first, second);
  for (const double whole : {-kFullTurn, kFullTurn}) {
    const double one = theta + whole - alpha, other = beta - theta - whole;
    if (against(one, other) >= least || (inflection && least < kNoRounding)) continue;
    least = against(one, other);
    first = one;
    second = other;
  }
  const auto kind = [](double turn, double kappa) {
    if (turn * kappa < 0.0) return Turning::kBack;
    return std::abs(turn) > std::numbers::pi ? Turning::kOverHalf : Turning::kShort;
  };
  return {kind(first, kappa_first), kind(second, kappa_second)};
}

/// Circle arc, or line when kappa is 0, from a point with a unit tangent to the next one.
struct Arc {
  Vec2 start, end;
  Vec2 start_tangent, end_tangent;
  double kappa = 0.0;
  bool over_half = false;  ///< turns by more than half a turn

  /// Whether the foot of p on the line or circle lies on the arc.
  [[nodiscard]] bool abreast(Vec2 from_start, Vec2 from_end) const {
    const bool after = dot(from_start, start_tangent) > 0.0,
               before = dot(from_end, end_tangent) < 0.0;
    return over_half ? after || before : after && before;
  }

  [[nodiscard]] double distance(Vec2 p) const {
    const Vec2 from_start = p - start, from_end = p - end;
    if (!std::isinf(kappa) && abreast(from_start, from_end)) return circle_distance(p);
    return std::sqrt(std::min(dot(from_start, from_start), dot(from_end, from_end)));
  }

  /// From the whole line or circle. A circle of radius 0 is its point.
  [[nodiscard]] double circle_distance(Vec2 p) const {
    const Vec2 from_start = p - start, left = left_normal(start_tangent);
    if (std::isinf(kappa)) return norm(from_start);
    if (kappa == 0.0) return std::abs(cross(start_tangent, from_start));
    // |p - centre| - R without the cancellation of a large circle
    const Vec2 radius = kappa * from_start - left;  // kappa-fold
    const double offset = dot(from_start, from_start) * kappa - 2.0 * dot(from_start, left);
    return std::abs(offset) / (norm(radius) + 1.0);
  }

  /// Positive where the distance from the line or circle grows on the way `ahead` from p.
  [[nodiscard]] double growth(Vec2 p, Vec2 ahead) const {
    const Vec2 from_start = p - start, left = left_normal(start_tangent);
    const double offset = dot(from_start, from_start) * kappa - 2.0 * dot(from_start, left);
    const double away = dot(kappa * from_start - left, ahead);
    return offset > 0.0 ? away : -away;
  }
};

/// Both arcs of a boundary in the chord's frame.
struct TwoArcs {
  Arc first, second;

  TwoArcs(const ChordFrame& f, const Boundary& b) {
    const Vec2 end = {f.h, 0.0};
    const Vec2 t = b.joint_tangent;
    // an arc of curvature k moves along the mean of its tangents, by tan(turn/2)/k of their sum
    const auto moved = [](Vec2 from, Vec2 to, double k) {
      return (cross(from, to) / ((1.0 + dot(from, to)) * k)) * (from + to);
    };
    Vec2 joint;
    if (std::isinf(b.kappa_first)) {
      joint = {};
    } else if (std::isinf(b.kappa_second)) {
      joint = end;
    } else if (std::abs(b.kappa_first) >= std::abs(b.kappa_second)) {
      joint = b.kappa_first == 0.0 ? end : moved(f.start_tangent, t, b.kappa_first);
    } else {
      joint = end - moved(t, f.end_tangent, b.kappa_second);
    }
    const auto [one, other] =
        turnings(f.start_tangent, t, f.end_tangent, b.kappa_first, b.kappa_second);
    first = {{}, joint, f.start_tangent, t, b.kappa_first, one == Turning::kOverHalf};
    second = {joint, end, t, f.end_tangent, b.kappa_second, other == Turning::kOverHalf};
  }
  [[nodiscard]] double distance(Vec2 p) const {
    return std::min(first.distance(p), second.distance(p));
  }
  /// The same for points near the boundary, at half the cost: from the arc on whose side of the
  /// common normal p lies. Never less than the distance.
  [[nodiscard]] double distance_from_near(Vec2 p) const {
    return (dot(p - second.start, second.start_tangent) < 0.0 ? first : second).distance(p);
  }
};

}  // namespace obvid::region_detail
