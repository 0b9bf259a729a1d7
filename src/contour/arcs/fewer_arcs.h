// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "biarc_along.h"
#include "obvid/core/internal/watch.h"
#include "track.h"

namespace obvid::arcs {

/// Where pairs of arcs are to go: along a contour between two places of it, and around where it is
/// closed.
struct PairsAlong {
  const Track& track;
  double from = 0.0, to = 0.0;
  bool closed = false;
  double tolerance = 0.0;
};

/// `pairs` pairs of arcs within the tolerance as samples tell, nodes first to last: places,
/// distances from the contour and headings of all nodes, and the legs of each pair, are those at
/// which a mean of a high power of the distances is least (docs/methods/gcode.md). Nothing where
/// none is found, which is no proof that there is none. Of an open contour the ends and the
/// headings there are the contour's.
[[nodiscard]] std::optional<std::vector<Node>> fitted_pairs(const PairsAlong& along,
                                                            std::size_t pairs, Watch* watch);

/// Integral of the cube root of the change of curvature over the tolerance: what the best arcs
/// take, of which each has one, where they are many.
[[nodiscard]] double best_number_of_arcs(const PairsAlong& along);

}  // namespace obvid::arcs
