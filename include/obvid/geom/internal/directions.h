// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/geom/vec3.h"

namespace obvid {

/// Angle between two directions of space, rad, in [0, pi]; to rounding where they nearly agree,
/// too.
[[nodiscard]] inline double angle_between(Vec3 a, Vec3 b) {
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

/// The same between two lines of these directions, in [0, pi / 2].
[[nodiscard]] inline double angle_between_lines(Vec3 a, Vec3 b) {
  return std::atan2(norm(cross(a, b)), std::abs(dot(a, b)));
}

}  // namespace obvid
