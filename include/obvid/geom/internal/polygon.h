// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Area of a closed polygon, positive where it goes around to the left; summed from its first
/// point, so that a place far from the origin costs no digits.
[[nodiscard]] inline double area_of_polygon(const std::vector<Vec2>& points) {
  double twice = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    twice += cross(points[i - 1] - points[0], points[i] - points[0]);
  }
  return 0.5 * twice;
}

/// Whether a closed polygon goes around a point an odd number of times; on its line either.
[[nodiscard]] inline bool is_in_polygon(const std::vector<Vec2>& points, Vec2 p) {
  bool inside = false;
  for (std::size_t i = 0, before = points.size() - 1; i < points.size(); before = i++) {
    const Vec2 a = points[before], b = points[i];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    if (a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) inside = !inside;
  }
  return inside;
}

}  // namespace obvid
