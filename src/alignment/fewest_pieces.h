// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/alignment/alignment.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/vec2.h"

namespace obvid::alignment {

/// Where a joint of an alignment lies.
struct Node {
  double place = 0.0;  ///< in intervals of the points: 2.5 is half way from point 2 to point 3
  Vec2 point;
  double theta = 0.0;  ///< rad, unwrapped
};

/// Fewest clothoids with common tangents (G1) that pass within `tolerance` of all points: nodes
/// from the first to the last point, one more than clothoids. The number is the fewest that this
/// search finds, among nodes at the points and at `options.divisions - 1` places between two of
/// them; deviations are linear in those of the nodes, so that a clothoid may be off by some
/// hundredths of the tolerance. Clothoids are as long and as blunt as `options` ask for, to first
/// order too.
///
/// Dynamic programming: which offsets and headings are possible at a place after k clothoids is
/// kept as a few convex polygons. Time grows with the points of a clothoid squared, linearly with
/// those of the series. Distinct neighbours, at least two points.
[[nodiscard]] Result<std::vector<Node>> fewest_pieces(const std::vector<Vec2>& points,
                                                      const std::vector<double>& tolerance,
                                                      const AlignmentOptions& options,
                                                      const RunContext& run = {});

}  // namespace obvid::alignment
