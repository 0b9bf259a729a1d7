// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// Largest distances of points from the regions of a contour of spirals.
struct RegionDistances {
  double farther = 0.0;  ///< from the farther boundary
  double outside = 0.0;  ///< from the region; 0: all inside, or no farther out than rounding
};

/// `points` follow a contour of spirals, in order: each is measured against the region between the
/// two joints that it lies between, told by the normals at the joints. Circular links, whose region
/// is the arc itself, do not count.
[[nodiscard]] RegionDistances place_in_regions(const Contour& spirals,
                                               const std::vector<Vec2>& points);

}  // namespace obvid::pipeline_detail
