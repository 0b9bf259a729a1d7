// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "chain_of_elements.h"
#include "winding.h"

namespace obvid::alignment {

/// Points [first, last] of a row, in order: of a closed one neither the first nor the last.
struct PointStretch {
  std::size_t first = 0, last = 0;
};

/// The chain on a map with the chords of a stretch, their corners rounded, in place of
/// what passes these points: from the middle between the point before them and the first one, with
/// the heading there, to the middle behind the last one. What lies beside stays as it is, and joins
/// it. Where the row begins or ends with the stretch, the chords do. Nothing where no chords lead
/// on, or where a transition of another kind than a clothoid would be cut.
[[nodiscard]] std::optional<FootedChain> with_rounded_chords(const Chain& chain,
                                                             const std::vector<Foot>& feet,
                                                             const PointRow& row,
                                                             const PointStretch& stretch);

}  // namespace obvid::alignment
