// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Of a point from the whole line (`kappa` 0) or circle that leaves `start` with heading `theta`,
/// without the cancellation of a large circle.
[[nodiscard]] inline double distance_from_circle(Vec2 start, double theta, double kappa, Vec2 p) {
  const Vec2 from = p - start, left = left_normal(unit_at(theta));
  return std::abs(dot(from, from) * kappa - 2.0 * dot(from, left)) /
         (norm(kappa * from - left) + 1.0);
}

}  // namespace obvid
