// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Arcs and lines in place of a contour.
struct ArcsAlong {
  std::vector<Piece> pieces;  ///< lines and arcs, each starts exactly where the one before ends
  double deviation = 0.0;     ///< largest distance of points of the contour from their arcs, units:
                              ///< measured at 24 places of each pair of arcs, good to some 2 %
};

/// Few tangent-continuous arcs and lines within `tolerance` (units) of a contour, for controllers
/// and systems that know nothing else. Pairs of arcs, each as long as the tolerance allows, over
/// the joints of the contour but not over vertices and corners: their radii are monotone where the
/// contour's curvature is. Exact lines and arcs of the contour stay whole. Nearly straight arcs
/// stay arcs. Errors: E203 a tolerance that is not greater than 0; E304 no pieces; E502 where no
/// pair of arcs, however short, is near enough (`index`: the piece). Cost: about 20 trials for each
/// pair.
[[nodiscard]] Result<ArcsAlong> arcs_along(const Contour& contour, double tolerance);

}  // namespace obvid
