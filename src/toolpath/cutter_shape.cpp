// SPDX-License-Identifier: Apache-2.0
#include "cutter_shape.h"

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {

double CutterShape::height(double distance) const {
  const double out = distance - flat();
  if (out <= 0.0) return 0.0;
  return corner - std::sqrt(std::max(0.0, corner * corner - out * out));
}

Vec2 CutterShape::offset(Vec3 normal) const {
  const double level = std::sqrt(normal.x * normal.x + normal.y * normal.y);
  if (!(level > 0.0)) return {};
  const double scale = corner + flat() / level;
  return {scale * normal.x, scale * normal.y};
}

Vec3 CutterShape::tip(Vec3 point, Vec3 normal) const {
  const Vec2 out = offset(normal);
  return {point.x + out.x, point.y + out.y, point.z + corner * (normal.z - 1.0)};
}

Result<CutterShape> shape_of(const Cutter& cutter) {
  const auto bad = [](const char* what, double value) {
    return error(ErrorCode::kBadOption, what).value(value);
  };
  const double radius = 0.5 * cutter.diameter;
  if (!std::isfinite(radius) || !(radius > 0.0)) {
    return bad("the cutter's diameter must be greater than 0", cutter.diameter);
  }
  switch (cutter.kind) {
    case CutterKind::kBall:
      return CutterShape{radius, radius};
    case CutterKind::kFlat:
      return CutterShape{radius, 0.0};
    case CutterKind::kBullNose:
      break;
  }
  if (!(cutter.corner_radius > 0.0) || !(cutter.corner_radius < radius)) {
    return bad("a bull nose's corner radius must lie between 0 and half its diameter",
               cutter.corner_radius);
  }
  return CutterShape{radius, cutter.corner_radius};
}

}  // namespace obvid::toolpath
