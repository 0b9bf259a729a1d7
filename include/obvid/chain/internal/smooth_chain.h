// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"

namespace obvid {

/// What became of the slopes of curvature at the joints of a chain.
struct SmoothedSlopes {
  std::size_t joints = 0;            ///< at which two slopes meet
  std::vector<std::size_t> stepped;  ///< elements at which the slope still steps, ascending
  int newton_steps = 0;
  bool converged = false;  ///< the fairest such chain was found, to rounding
};

/// Changes headings and curvatures of a chain so that curvature and its slope are continuous (G3):
/// equal slopes inside runs, zero slopes where the direction changes and beside arcs and lines. One
/// closed-form spiral carries each link; a link with slopes of zero at both ends is halved. Points,
/// directions, given headings and curvatures and the signs of curvatures at vertices and ends stay
/// as they are, so no vertex and no inflection is added. Of all such chains the one whose slopes
/// are most even, in the sense of `SpiralSlopes::change` and `bend` (docs/methods/g3.md).
///
/// `keep` is empty or has one entry per link: runs that have such a link stay as they are.
/// Joints for which no common slope was found keep their step and are named. When nothing at all
/// can be done `chain` stays as it was but for its marks, and all joints are named. `loop`: the
/// last element is the first again. Deterministic; scale- and motion-invariant; the reversed chain
/// gives the reversed result. Cost O(n), as a rule about six Newton steps, for loops twice to
/// thrice that. `seam`: what was given at the first element of a loop, which the chain holds; where
/// the loop begins does not matter to the result.
[[nodiscard]] SmoothedSlopes smooth_slopes(SeriesChain& chain, bool loop, Watch& watch,
                                           std::vector<bool> keep = {}, const NodeData& seam = {});

}  // namespace obvid
