// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/chain/internal/series_chain.h"

namespace obvid::chain_detail {

/// Why a series has no chain, for the user.
[[nodiscard]] Error explain(const std::vector<Vec2>& points, const Analysis& analysis,
                            const ChainConstraints& constraints, const Infeasibility& why);

/// Whether any heading, curvature or convexity was asked for.
[[nodiscard]] bool anything_constrained(const ChainConstraints& constraints);

}  // namespace obvid::chain_detail
