// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"
#include "obvid/toolpath/toolpath.h"

namespace obvid::toolpath {

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
  /// Distance of a point from the body, its place given from the tip; negative inside.
  [[nodiscard]] double distance(Vec3 from_tip) const;
};

/// Errors: E203.
[[nodiscard]] Result<CutterShape> shape_of(const Cutter& cutter);

}  // namespace obvid::toolpath
