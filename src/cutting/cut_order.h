// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "leads.h"
#include "outlines.h"

namespace obvid::cutting {

/// A track with the place where it begins.
struct Visit {
  std::size_t track = 0;
  ArcPath path;  ///< begins there
  std::optional<ArcPiece> lead_in, lead_out;
  bool lead_left_out = false;  ///< there is no room for one anywhere
};

[[nodiscard]] Vec2 begin_of(const Visit& visit);

/// Closed tracks begin as near to `near` as they can, nothing: to where the tool comes from, at
/// first the origin: at any place of their pieces, with a lead where there is room for one: at
/// the nearest of many places, then as near as moving it along its piece brings it. Open ones begin
/// at either end. The nearest of those that may be next is taken, then visits are moved to other
/// turns as long as that shortens the way between them.
[[nodiscard]] std::vector<Visit> ordered(const Tracks& tracks, std::optional<Vec2> near,
                                         const Leads& leads, Watch& watch);

}  // namespace obvid::cutting
