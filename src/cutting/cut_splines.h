// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "cut_blocks.h"
#include "obvid/core/internal/watch.h"

namespace obvid::cutting {

struct SplineRules {
  double within = 0.0;      ///< units of the machine: how far a cubic may be off the arcs
  double last_digit = 0.0;  ///< that is printed: the feed is that of the printed cubic
};

/// Cubics (G5) in place of three or more arcs of different radii that follow each other smoothly at
/// one height: each from joint to joint with the headings there, as long as was found to stay
/// within `within` (units of the machine; `path_distance`, both ways). A cubic turns by a right
/// angle at most and has the feed of its sharpest place. Lines, circles and what nothing joins stay
/// as they are. Where `watch` ends it, some stay too.
[[nodiscard]] std::vector<CutBlock> with_splines(std::vector<CutBlock> blocks,
                                                 const BlockRules& rules,
                                                 const SplineRules& splines, Watch& watch);

}  // namespace obvid::cutting
