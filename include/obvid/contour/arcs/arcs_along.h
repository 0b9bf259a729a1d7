// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Arcs and lines in place of a contour.
struct ArcsAlong {
  std::vector<Piece> pieces;  ///< lines and arcs, each starts exactly where the one before ends
  double deviation = 0.0;     ///< largest distance between both curves, units: measured both ways
                              ///< (`path_distance`), good to some 1 %
};

/// Few tangent-continuous arcs and lines within `tolerance` (units) of a contour, for controllers
/// and systems that know nothing else. Pairs of arcs from point to point of the contour, over its
/// joints and not over corners; exact lines and arcs stay whole. Headings are the contour's at its
/// ends, at corners, and beside lines and arcs that stay; between pairs they lean off it by what
/// halves the error, so each arc crosses the contour in its middle (docs/methods/gcode.md). Where
/// the contour's curvature is monotone the arcs' is, unless only others are near enough. Every arc
/// turns by less than half a turn, except arcs of the contour.
/// Errors: E203 a tolerance that is not greater than 0; E311 no pieces; E502 more than a million
/// arcs would be needed (`value`: how many, about), or the tolerance is below the rounding of the
/// coordinates; E103 where `watch` ends it. Cost: about 1 ms for an arc, a tenth of it where there are more than 1,000.
[[nodiscard]] Result<ArcsAlong> arcs_along(const Contour& contour, double tolerance,
                                           Watch* watch = nullptr);

}  // namespace obvid
