// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Of a point from the whole line (`kappa` 0) or circle that leaves `start` along a unit vector,
/// without the cancellation of a large circle; to the left positive.
[[nodiscard]] inline double distance_beside_circle(Vec2 start, Vec2 tangent, double kappa, Vec2 p) {
  const Vec2 from = p - start, left = left_normal(tangent);
  return (2.0 * dot(from, left) - kappa * dot(from, from)) / (1.0 + norm(kappa * from - left));
}

/// The same with a heading, without a sign.
[[nodiscard]] inline double distance_from_circle(Vec2 start, double theta, double kappa, Vec2 p) {
  return std::abs(distance_beside_circle(start, unit_at(theta), kappa, p));
}

}  // namespace obvid
