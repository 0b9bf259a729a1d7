// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/cutting/cutting.h"
#include "obvid/geom/internal/box.h"
#include "offset_path.h"

namespace obvid::cutting {

/// An outline as arcs, and the path of the tool's axis along it. Lengths in units of the machine.
struct Track {
  std::size_t outline = 0;
  std::string name;
  ArcPath edge;                    ///< what stays lies to its right
  Box2 room;                       ///< around the edge
  ArcPath axis;                    ///< the parallel; runs as the tool runs
  std::size_t around = 0;          ///< closed outlines around it
  std::vector<std::size_t> first;  ///< tracks that have to be cut before it: those inside
  CutSide side = CutSide::kOn;
  double deviation = 0.0;  ///< of `edge` from the contour
  std::vector<Parallel::InnerCorner> corners;
};

/// Errors: those of `cut`.
[[nodiscard]] Result<std::vector<Track>> tracks_of(const std::vector<CutOutline>& outlines,
                                                   const CutOptions& options, double scale,
                                                   Watch& watch);

/// Whether a point lies inside of a closed path. It must not lie on it.
[[nodiscard]] bool is_inside(const ArcPath& path, Vec2 point);

/// Nearest distance of a point from the edges of tracks whose side is compensated; infinite
/// without.
[[nodiscard]] double distance_from_edges(const std::vector<Track>& tracks, Vec2 point);

}  // namespace obvid::cutting
