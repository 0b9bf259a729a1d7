// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid::pipeline_detail {

/// Steps of the slope of curvature up to this are called none: a half of what a proof allows.
inline constexpr double kClearlyContinuous = 5e-7;

/// Step of d kappa/ds where a piece begins, of the largest slope at the ends of both pieces that
/// meet there; the piece before the first is the last. 0 where all are lines and arcs, NaN where a
/// slope has no bound. Rounded, not proved.
[[nodiscard]] double slope_step_before(const std::vector<Piece>& pieces, std::size_t piece);

}  // namespace obvid::pipeline_detail
