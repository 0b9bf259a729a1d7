// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut_blocks.h"
#include "obvid/exchange/internal/gcode/motion_time.h"

namespace obvid::cutting {

/// Seconds that the blocks take from the origin (`MotionTime`); rapid moves and moves straight down
/// or up begin and end at rest.
[[nodiscard]] double seconds_of(const std::vector<CutBlock>& blocks,
                                const exchange::MotionRules& rules, double pierce_seconds);

}  // namespace obvid::cutting
