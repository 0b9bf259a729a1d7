// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "pass_families.h"

namespace obvid::toolpath {

/// Passes in order with links, lifts and plunges between them; lengths and times in the report.
void lay_moves(const Family& family, const ToolpathOptions& options, double level_step,
               Walker& walker, Toolpath& out);

/// Points of a line thinned out: each dropped one stays within `within` of its chord.
[[nodiscard]] std::vector<Vec3> thinned(const std::vector<Vec3>& points, double within);

/// Largest distance of points first .. last from the chord between them.
[[nodiscard]] double off_chord(const std::vector<Vec3>& points, std::size_t first,
                               std::size_t last);

/// The last index up to which `good(last)` holds, by doubling and halving; at least first + 1.
template <class Good>
[[nodiscard]] std::size_t furthest_good(std::size_t first, std::size_t end, const Good& good) {
  std::size_t low = first + 1, width = 1;
  while (low + width <= end && good(low + width)) {
    low += width;
    width *= 2;
  }
  for (; width > 0; width /= 2) {
    if (low + width <= end && good(low + width)) low += width;
  }
  return low;
}

}  // namespace obvid::toolpath
