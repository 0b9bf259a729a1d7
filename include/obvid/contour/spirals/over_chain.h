// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Pieces over the elements: closed-form spirals, and arcs or lines over circular stretches.
/// Error E501 when a piece came out with a weight that is not positive.
[[nodiscard]] Result<Contour> spirals_over(const std::vector<Vec2>& points,
                                           const SeriesChain& chain);

/// Makes the stored slopes of curvature of spirals those of their links, which are equal on both
/// sides of a joint (`keep_end_slopes`). `contour` is formed from `chain`, its curvatures are kept
/// already. Pieces of links that came out in parts turn far and stay as they are.
void keep_joint_slopes(const SeriesChain& chain, Contour& contour);

}  // namespace obvid
