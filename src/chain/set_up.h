// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/chain/series_chain.h"

namespace obvid::chain_detail {

/// The chain's problem for a series: directions and cones from the analysis, given data and the
/// data of circular stretches fixed. Error E403 when wishes contradict the points.
[[nodiscard]] Result<ChainProblem> set_up(const Analysis& analysis, const ChainWishes& wishes);

/// Why a series has no chain, for the user.
[[nodiscard]] Error explain(const std::vector<Vec2>& points, const Analysis& analysis,
                            const ChainWishes& wishes, const Infeasibility& why);

/// Whether any heading, curvature or convexity was asked for.
[[nodiscard]] bool anything_wished(const ChainWishes& wishes);

}  // namespace obvid::chain_detail
