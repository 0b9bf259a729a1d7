// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/element.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::alignment {

/// What elements lie in. In both planes they join with common tangents and their curvature is
/// linear in their length, so that one search and one fit serve both.
enum class Plane {
  kMap,    ///< x and y: headings in rad, lengths along the curve, offsets across it
  kGraph,  ///< heights y over stations x: a heading is the slope dy/dx, a length lies along x, a
           ///< curvature is d2y/dx2, an offset is upright. An arc is a parabola. Turning shears.
};

/// Which elements are looked for.
struct Sought {
  Plane plane = Plane::kMap;
  bool constant = false;  ///< curvature along each of them: arcs and lines only
  Vec2 lap{};  ///< of closed ones, from the start to where it is reached again: none on a map
  /// The search is one in a graph, where corners of the points, which vertical curves round, count
  /// as one element each, and no slope is steeper than the points around it bear.
  bool corners = false;
  /// Of profiles: no search, but few grades that meet at heights, with rounded corners.
  bool rounded = false;
};

/// Direction of a heading.
[[nodiscard]] inline Vec2 forward(Plane plane, double theta) {
  return plane == Plane::kMap ? unit_at(theta) : Vec2{1.0, theta};
}

/// How the direction changes with the heading.
[[nodiscard]] inline Vec2 sideways(Plane plane, double theta) {
  return plane == Plane::kMap ? left_normal(unit_at(theta)) : Vec2{0.0, 1.0};
}

/// How the end of an arm moves when what holds it turns.
[[nodiscard]] inline Vec2 turned(Plane plane, Vec2 arm) {
  return plane == Plane::kMap ? left_normal(arm) : Vec2{0.0, arm.x};
}

/// What a vector is multiplied with to be measured along a heading; across it is
/// `left_normal(forward)` in both planes.
[[nodiscard]] inline Vec2 lengthwise(Plane plane, double theta) {
  return plane == Plane::kMap ? unit_at(theta) : Vec2{1.0, 0.0};
}

/// From one heading to another.
[[nodiscard]] inline double turn_between(Plane plane, double from, double to) {
  return plane == Plane::kMap ? obvid::turn_between(from, to) : to - from;
}

/// From the start of an element to its place at `s`, where its curvature is `kappa1`.
[[nodiscard]] inline Vec2 step_along(Plane plane, double theta, double kappa0, double kappa1,
                                     double s) {
  if (plane == Plane::kMap) return clothoid_step(theta, kappa0, kappa1, s);
  return {s, s * (theta + s * (2.0 * kappa0 + kappa1) / 6.0)};
}

/// The element at `s` behind `start`, where curvature changes by `sharpness` a unit.
[[nodiscard]] inline Element element_behind(Plane plane, const Element& start, double sharpness,
                                            double s) {
  if (plane == Plane::kMap) return clothoid_at(start, sharpness, s);
  const double kappa = start.kappa + sharpness * s;
  return {start.point + step_along(plane, start.theta, start.kappa, kappa, s),
          start.theta + 0.5 * (start.kappa + kappa) * s, kappa};
}

}  // namespace obvid::alignment
