// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "outlines.h"

namespace obvid::cutting {

/// What tracks have in common that are followed on the line.
struct CommonEdges {
  struct Place {
    std::size_t one = 0, other = 0;  ///< tracks
    Vec2 at;
  };
  double again = 0.0;  ///< length along which a track lies on one before it
  std::optional<Place> first_again{};
  std::size_t crossings = 0;  ///< pairs of closed tracks that cross
  std::optional<Place> first_crossing{};
};

/// Found of pieces that lie on each other within `within` at five places of what they share, and
/// that cross farther than that from their ends. Cancelled: what was found so far.
[[nodiscard]] CommonEdges common_edges(const std::vector<Track>& tracks, double within,
                                       Watch& watch);

}  // namespace obvid::cutting
