// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "reach.h"
#include "surface_cells.h"

namespace obvid::toolpath {

/// A cell that a cutter does not come to.
struct HeldCell {
  std::size_t cell = 0;
  Nearest came;
  double stays = 0.0;  ///< there at least, however near the cutter can come

  [[nodiscard]] double height() const { return std::max(came.height, stays); }
};

/// The one over which most stays; nothing stays where there is none. What is known of cells may be
/// too much, so those where it is most are looked at closer, until no other can have more; where
/// too many may, it is still no less. Error: E103.
[[nodiscard]] Result<HeldCell> deepest_of(const Part& part, const SurfaceCells& cells,
                                          std::vector<HeldCell> held, std::size_t threads,
                                          const RunContext& run);

}  // namespace obvid::toolpath
