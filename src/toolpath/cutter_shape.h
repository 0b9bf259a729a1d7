// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

/// Distance from a cutter's body, and how it changes away from the axis and upwards.
struct BodyDistance {
  double value = 0.0;  ///< negative inside
  double by_level = 0.0, by_height = 0.0;
};

/// The body that a cutter sweeps when it turns: above the tip, a disc of radius `flat()` whose rim
/// is rounded by `corner`, then a cylinder of radius `radius`.
struct CutterShape {
  double radius = 0.0;
  double corner = 0.0;

  [[nodiscard]] double flat() const { return radius - corner; }
  /// Height of the body's lower side above the tip at a distance from the axis, at most `radius`.
  [[nodiscard]] double height(double distance) const;
  /// From the axis to the point that touches a surface with this normal (length 1, upwards), turned
  /// round: axis = point + offset. Level surfaces touch at the axis.
  [[nodiscard]] Vec2 offset(Vec3 normal) const;
  /// Place of the tip that touches the point of a surface with this normal.
  [[nodiscard]] Vec3 tip(Vec3 point, Vec3 normal) const;
  /// The body is all that lies within the corner's radius of an upright cylinder of radius flat()
  /// that begins at the height of the corner: so is its distance, inside as well as outside.
  [[nodiscard]] BodyDistance distance(double from_axis, double over_tip) const {
    const double out = from_axis - flat(), below = corner - over_tip;
    if (below <= 0.0 && out > below) return {out - corner, 1.0, 0.0};
    if (out <= 0.0) return {below - corner, 0.0, -1.0};
    const double far = std::sqrt(out * out + below * below);
    return {far - corner, out / far, -below / far};
  }
};

/// Errors: E203.
[[nodiscard]] Result<CutterShape> shape_of(const Cutter& cutter);

}  // namespace obvid::toolpath
