// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Elements for every point: from the chain, or from the one circle or line that 2 or 3 points or
/// a wholly circular series determine.
[[nodiscard]] Result<SeriesChain> form_elements(const std::vector<Vec2>& points,
                                                const Analysis& analysis,
                                                const ChainConstraints& constraints, Watch& watch);

/// Two or three points, which lie on one circle or line whatever curve was meant.
[[nodiscard]] bool is_few_on_one_circle(const std::vector<Vec2>& points, const Analysis& analysis);

/// Whether more than 3 points lie on one circle or line that has all that is given: to 1e-6 rad and
/// 1e-6 of the curvature, or to what the rounding of the coordinates leaves of it.
[[nodiscard]] bool is_one_circle(const std::vector<Vec2>& points, const Analysis& analysis,
                                 const ChainConstraints& constraints);

/// A piece of a drawing as it is, between two points of the series (`from`, `to`: their indices).
[[nodiscard]] Contour form_kept(const Piece& piece, const std::vector<Vec2>& points,
                                std::size_t from, std::size_t to);

}  // namespace obvid::pipeline_detail
