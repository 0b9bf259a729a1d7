// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/geom/vec2.h"

namespace obvid::pipeline_detail {

/// Part of a chain between two neighbouring points that does what the points do not ask for.
struct WanderingPart {
  std::size_t first = 0, last = 0;  ///< elements of the chain, both on points
  double beyond = 0.0;  ///< rad by which it leaves the headings of the circles around it
  double turn = 0.0;    ///< rad between its extreme headings
};

/// What is senseless, and what only looks so (docs/methods/pipeline.md, "Parts that wander").
struct Wandering {
  std::vector<WanderingPart> senseless;  ///< headings far outside what the circles ask for
  std::vector<WanderingPart> guessed;    ///< over one long chord between short ones the contour
                                         ///< turns by more than a right angle, as the circles do
};

/// Looks at all parts of a chain. `reach` holds how far each element's point may have been moved;
/// parts that touch an element of `given` follow what the user asked for and are not judged.
/// `loop`: the last element is the first one again. O(n).
[[nodiscard]] Wandering find_wandering(const SeriesChain& chain, const std::vector<double>& reach,
                                       const std::vector<bool>& given, bool loop);

/// Headings at a point that do not swing out: that of the circle through it and its neighbours,
/// then others between both chords, the nearer to the circle's first.
[[nodiscard]] std::vector<double> calm_headings(Vec2 before, Vec2 at, Vec2 after);

}  // namespace obvid::pipeline_detail
