// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// Neighbouring pieces of one direction make one run. `begins(i)`: whether piece i begins a run
/// whatever its direction is, as after a corner.
template <class Begins>
[[nodiscard]] std::vector<Run> collect_runs(const std::vector<int>& direction,
                                            const Begins& begins) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < direction.size(); ++i) {
    if (!runs.empty() && runs.back().direction == direction[i] && !begins(i)) {
      runs.back().last_piece = i;
    } else {
      runs.push_back({i, i, direction[i]});
    }
  }
  return runs;
}

[[nodiscard]] inline std::vector<Run> collect_runs(const std::vector<int>& direction) {
  return collect_runs(direction, [](std::size_t) { return false; });
}

/// Direction of every piece: its run's.
[[nodiscard]] inline std::vector<int> piece_directions(const Contour& contour) {
  std::vector<int> direction(contour.pieces.size(), 0);
  for (const Run& run : contour.runs) {
    for (std::size_t i = run.first_piece; i <= run.last_piece && i < direction.size(); ++i) {
      direction[i] = run.direction;
    }
  }
  return direction;
}

}  // namespace obvid
