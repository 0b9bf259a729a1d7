// SPDX-License-Identifier: Apache-2.0
#include "deepest.h"

#include "obvid/core/internal/parallel.h"

namespace obvid::toolpath {

Result<HeldCell> deepest_of(const Part& part, const SurfaceCells& cells, std::vector<HeldCell> held,
                            std::size_t threads, const RunContext& run) {
  constexpr std::size_t kDeepestTogether = 128, kMostDeepest = 4096;  // cells looked at closer
  std::sort(held.begin(), held.end(), [](const HeldCell& a, const HeldCell& b) {
    return a.height() != b.height() ? a.height() > b.height() : a.cell < b.cell;
  });
  HeldCell best;
  const auto more = [&](const HeldCell& one) { return one.height() > best.height(); };
  std::size_t begin = 0;
  while (begin < std::min(held.size(), kMostDeepest) && more(held[begin])) {
    const std::size_t count = std::min(kDeepestTogether, held.size() - begin);
    OBVID_TRY(in_parallel(count, with_threads(run, threads), [&](std::size_t k) {
      HeldCell& one = held[begin + k];
      const Cell& cell = cells.cells()[one.cell];
      if (one.came.height > one.stays) {
        one.came = closer_to(part, cell.point, cell.normal, one.came);
      }
    }));
    for (std::size_t k = begin; k < begin + count; ++k) {
      if (more(held[k])) best = held[k];
    }
    begin += count;
  }
  if (begin < held.size() && more(held[begin])) best = held[begin];
  return best;
}

}  // namespace obvid::toolpath
