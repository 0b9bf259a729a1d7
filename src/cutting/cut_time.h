// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut_blocks.h"

namespace obvid::cutting {

struct TimeRules {
  double rapid_feed = 0.0;    ///< a minute
  double acceleration = 0.0;  ///< length/s^2
  double corner = 0.0;        ///< how far a controller may cut corners: sets the speed there
  double pierce_seconds = 0.0;
};

/// Seconds that the blocks take: along each with the least time that its feed, the acceleration and
/// the speeds at its ends allow. At a corner the speed is that of a circle tangent to both sides
/// that stays `corner` away from it (the rule of grbl and LinuxCNC's G64 P). An estimate:
/// controllers look so many blocks ahead as they can.
[[nodiscard]] double seconds_of(const std::vector<CutBlock>& blocks, const TimeRules& rules);

}  // namespace obvid::cutting
