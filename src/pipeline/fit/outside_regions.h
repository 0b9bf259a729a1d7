// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// A number of the input point that a joint stands on, or of the corner between two that it is.
[[nodiscard]] std::optional<std::size_t> station_of(const Contour& contour, std::size_t joint);

/// Point of a curve; `source`: the `station_of` the joint that it is, if any.
struct CurvePoint {
  Vec2 point;
  std::optional<std::size_t> source;
};

/// `points` follow a contour of spirals, in order: each is measured against the region between the
/// two joints that it lies between. Input points tell which these are; between them the normals at
/// the joints do. The region of a circular link is its arc. Returns the largest distance from the
/// region; 0: all inside, or no farther out than rounding.
[[nodiscard]] double distance_outside_regions(const Contour& spirals,
                                              const std::vector<CurvePoint>& points, Watch& watch);

}  // namespace obvid::pipeline_detail
