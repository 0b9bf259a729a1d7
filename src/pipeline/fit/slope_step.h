// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/curve/pieces.h"

namespace obvid::pipeline_detail {

/// Steps of the slope of curvature up to this are called none: a half of what a proof allows.
inline constexpr double kClearlyContinuous = 0.5 * kContinuousSlope;

/// Step of d kappa/ds where a piece begins, of the largest slope of both pieces that meet there (at
/// their ends, and the mean over each chord: it may vanish at both ends); the piece before the
/// first is the last. 0 where all are lines and arcs, NaN where a slope has no bound. Rounded, not
/// proved.
[[nodiscard]] double slope_step_before(const std::vector<Piece>& pieces, std::size_t piece);
/// The largest of all joints between pieces, of a `loop` that before the first piece too.
[[nodiscard]] double largest_slope_step(const std::vector<Piece>& pieces, bool loop);

}  // namespace obvid::pipeline_detail
