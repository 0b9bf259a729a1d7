// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "edges.h"
#include "obvid/core/internal/watch.h"
#include "obvid/cutting/cutting.h"
#include "obvid/geom/internal/box.h"
#include "offset_path.h"

namespace obvid::cutting {

/// An outline as arcs, and the path of the tool's axis along it. Lengths in units of the machine.
struct Track {
  std::size_t outline = 0;  ///< of several curves that were joined the first one
  std::string name;
  bool is_cut = true;              ///< else it only says what lies in what
  ArcPath edge;                    ///< what stays lies to its right
  Box2 room;                       ///< around the edge
  ArcPath axis;                    ///< the parallel; runs as the tool runs
  std::size_t around = 0;          ///< closed outlines around it
  std::vector<std::size_t> first;  ///< tracks that have to be cut before it: those inside
  CutSide side = CutSide::kOn;
  double deviation = 0.0;  ///< of `edge` from the contour
  std::vector<Parallel::InnerCorner> corners;
};

struct Tracks {
  std::vector<Track> all;
  Edges edges;  ///< of tracks whose side is compensated, by their numbers
  std::vector<std::string> warnings;
};

/// `share`: of the tolerance, for arcs in place of curves. Errors: those of `cut`.
[[nodiscard]] Result<Tracks> tracks_of(const std::vector<CutOutline>& outlines,
                                       const CutOptions& options, double scale, double share,
                                       Watch& watch);

/// Whether a point lies inside of a closed path. It must not lie on it.
[[nodiscard]] bool is_inside(const ArcPath& path, Vec2 point);

/// What cubics in place of a path may be off it, of a share of the tolerance for both.
[[nodiscard]] double spline_tolerance(double tolerance, double share);

/// Distance between places on a path that are looked at: a part of the tool's radius, but no more
/// places than can be looked at in seconds.
[[nodiscard]] double spacing_of(const std::vector<Track>& tracks, double tool_radius,
                                double levels = 1.0);

}  // namespace obvid::cutting
