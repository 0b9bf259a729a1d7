// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface_builders/internal/scatter.h"
#include "plane_neighbours.h"

namespace obvid {

/// A place in a plane and the height over it.
struct PlacedHeight {
  Vec2 place;
  double height = 0.0;
};

/// The neighbours of each point: `kScatterNeighbours` nearest others, fewer where there are not so
/// many; `number` says how many.
inline constexpr std::size_t kScatterNeighbours = 16;
struct ScatterNeighbours {
  std::size_t number = 0;
  std::vector<std::size_t> of;  ///< those of point i from i * number on, nearest first

  [[nodiscard]] const std::size_t* begin_of(std::size_t i) const { return of.data() + i * number; }
};
[[nodiscard]] Result<ScatterNeighbours> neighbours_of(const std::vector<PlacedHeight>& points,
                                                      const PlaneNeighbours& tree,
                                                      const RunContext& run);

/// Points whose neighbours agree with each other and not with them: the plane through the
/// neighbours alone that large residuals hardly turn (weights of Huber 1964) passes the point by
/// more than `kOutlierFactor` (1 + sqrt(k h)) s. s: 1.4826 times the median of the neighbours'
/// residuals, at least a quarter of the tolerance; h: the variance of the plane there in units of
/// that of a residual; k: their number. So h k is 1 in the middle of neighbours and larger at
/// borders, where the plane is extrapolated. Not found: groups that are half of their neighbours or
/// more.
inline constexpr double kOutlierFactor = 4.0;
[[nodiscard]] Result<std::vector<ScatterOutlier>> outliers_among(
    const std::vector<PlacedHeight>& points, const ScatterNeighbours& neighbours, double tolerance,
    const RunContext& run);

}  // namespace obvid
