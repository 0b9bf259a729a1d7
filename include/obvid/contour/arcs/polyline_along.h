// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Chords in place of a contour.
struct PolylineAlong {
  std::vector<Vec2> points;  ///< on the contour, its ends and corners among them
  double deviation = 0.0;    ///< largest distance between chords and contour, units
};

/// A polyline on a contour within `tolerance` (units): from each point the longest chord that stays
/// as near, corners kept. Exact lines stay whole. Errors: E203 a tolerance that is not greater
/// than 0; E311 no pieces; E502 more than ten million points would be needed (`value`: how many),
/// or coordinates are too coarse for the tolerance; E103 where `watch` ends it.
[[nodiscard]] Result<PolylineAlong> polyline_along(const Contour& contour, double tolerance,
                                                   Watch* watch = nullptr);

}  // namespace obvid
