// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "cutter_shape.h"

namespace obvid::toolpath {

/// Where a cutter that comes down rests: on the inside, an edge or a corner of a triangle.
struct Rest {
  double tip_z = 0.0;
  Vec3 point;
  int feature = 0;  ///< 0: inside; 1, 2, 3: edge from corner 0, 1, 2; 4, 5, 6: corner 0, 1, 2
};

using Triangle = std::array<Vec3, 3>;

/// Raises `rest` when the cutter, coming down along the axis through `axis`, meets the triangle
/// before `rest.tip_z`; true then. The exact greatest height for each of the seven features but
/// those whose bits are set in `skipped`.
[[nodiscard]] bool drop_on(const CutterShape& cutter, Vec2 axis, const Triangle& triangle,
                           unsigned skipped, Rest& rest);

/// Height of the triangle over a place, and the corners' weights; false: not over it.
[[nodiscard]] bool height_over(const Triangle& triangle, Vec2 place, double& z,
                               std::array<double, 3>& weights);

}  // namespace obvid::toolpath
