// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/vec2.h"

namespace obvid::cutting {

/// What a tour comes by: entered at `begin`, left at `end`.
struct Stop {
  Vec2 begin, end;
  bool may_turn = false;           ///< it may as well be entered at `end` and left at `begin`
  std::vector<std::size_t> first;  ///< stops that have to come before it
};

/// One stop of a tour.
struct Turn {
  std::size_t stop = 0;
  bool turned = false;  ///< entered at its end
};

/// Length of the ways between the stops, the one from the origin to the first included.
[[nodiscard]] double way_between(const std::vector<Stop>& stops, const std::vector<Turn>& tour);

/// A tour of the same stops that is no longer: parts of it are turned round (2-opt, [Croes 1958])
/// and up to three stops at a time moved elsewhere (Or-opt, [Or 1976]) as long as that shortens it;
/// then neighbouring parts change places at random, and what is shorter behind the same moves
/// stays, at first what is little longer, too (iterated local search, [Johnson 1990]). Stops come
/// behind those in their `first`, if they do so in the given tour. No bound of the shortest tour.
/// The same result for the same input; cancelled: the best so far.
[[nodiscard]] std::vector<Turn> shorter_tour(const std::vector<Stop>& stops, std::vector<Turn> tour,
                                             Watch& watch);

}  // namespace obvid::cutting
