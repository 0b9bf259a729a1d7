// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"

namespace obvid {

/// Elements first..last of a chain, with what is known of them and of the links between them;
/// counts of the whole stay behind.
[[nodiscard]] SeriesChain slice_of(const SeriesChain& chain, std::size_t first, std::size_t last);

/// Elements of a chain that were chosen again, both ends included; all others are as they were.
struct ChangedElements {
  std::size_t first = 0, last = 0;
};

/// Chooses headings and curvatures again after one point moved: those of its neighbourhood alone,
/// as wide as a change makes itself felt beyond 1e-9 of the turning of a link. The result is that
/// of `choose_elements` for all points, to what either leaves of its Newton iteration.
///
/// `chain` is what `choose_elements` found for the points before (the first one at both ends of a
/// `loop`), one element to a point, no free ones; `points` are those after the move. Nothing, and
/// the chain as it was, where that does not do: beside lines and arcs, where a direction changes
/// farther off than beside the point, across the seam of a loop, where the neighbourhood is nearly
/// the whole, or where no such elements are found.
[[nodiscard]] std::optional<ChangedElements> follow_moved_point(const std::vector<Vec2>& points,
                                                                std::size_t moved, bool loop,
                                                                SeriesChain& chain, Watch& watch);

/// Makes slopes equal again after a part of a chain was chosen anew, starting from the chain
/// `smooth` that `smooth_slopes` made of `before`; `after` is the same chain with the elements
/// `changed`. Nothing, and `smooth` as it was, where a neighbourhood does not do: where links were
/// halved or joints step, across the seam of a loop and where it was cut, where the directions are
/// others, or where no equal slopes are found.
[[nodiscard]] std::optional<ChangedElements> follow_changed_elements(const SeriesChain& before,
                                                                     const SeriesChain& after,
                                                                     const ChangedElements& changed,
                                                                     bool loop, SeriesChain& smooth,
                                                                     Watch& watch);

}  // namespace obvid
