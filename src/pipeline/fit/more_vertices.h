// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Elements for points through which no curve with the directions of the analysis runs: with
/// vertices moved or put between the points (`exact_runs`). Circular stretches are kept; where
/// fewer vertices do without those of four points, which rounding alone can put on one circle, they
/// are let go. Errors as `follow_directions`.
[[nodiscard]] Result<SeriesChain> with_more_vertices(const std::vector<Vec2>& points,
                                                     const Analysis& analysis,
                                                     const ChainConstraints& constraints,
                                                     Watch& watch);

}  // namespace obvid::pipeline_detail
