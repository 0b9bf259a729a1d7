// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/fairing/internal/fairing.h"
#include "tube.h"

namespace obvid::fairing_detail {

/// A tube with a smooth curve inside it: the reference of its nodes, and offsets in `state`.
struct SmoothTube {
  Tube tube;
  State state;
  std::vector<std::size_t> source;       ///< per node: index of its measured point, of a primitive
  std::vector<std::size_t> last_source;  ///< its first one, and its last one
  int newton_steps = 0;
  bool inside = true;  ///< false: with its primitives no curve was found that stays in the tube
  std::size_t trouble = 0;  ///< node farthest outside then
};

/// Where a closed tube is cut: far from any vertex, or a quarter of its nodes away from there.
enum class Seam { kSteepest, kElsewhere };

/// Chooses nodes among the points and lays a smooth curve through the tube, without regard to
/// directions. Where primitives are wanted, stretches that mean a line or circle become one node
/// each, except those with an `loose` point.
[[nodiscard]] SmoothTube build_tube(const MeasuredSeries& series,
                                    const std::vector<std::size_t>& loose, Watch& watch,
                                    Seam seam = Seam::kSteepest);

/// Expected sizes of all links from the curvatures at x: the largest mean rate of curvature over
/// three links before, after and around, but not less than what the tolerance can hide.
void set_sizes(Tube& tube, const State& x);

}  // namespace obvid::fairing_detail
