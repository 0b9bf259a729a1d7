// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Points of a series that may be the corners of a polygon, or a coarse sampling of a curve: nobody
/// can tell from them.
struct CoarsePolygon {
  double turn = 0.0;                 ///< the middle one of the turns, rad
  std::vector<std::size_t> corners;  ///< points that turn by at least the wanted angle, ascending

  [[nodiscard]] bool found() const { return !corners.empty(); }
};

/// Turns at points that are to be judged: beyond rounding, between chords of eight tolerances at
/// least. Where the middle one of them is 40 degrees or more (an octagon, or coarser) the series is
/// such a polygon, and `corners` are its points that turn by `angle` (rad); else nothing is found.
/// Nor is it where the curvatures of the circles through three neighbours only grow, or only fall.
/// `tolerance` is empty or has one entry per point. O(n log n).
[[nodiscard]] CoarsePolygon coarse_polygon(const std::vector<Vec2>& points,
                                           const std::vector<double>& tolerance, bool closed,
                                           double angle);

}  // namespace obvid
