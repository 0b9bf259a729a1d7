// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Arcs and lines in place of a contour.
struct ArcsAlong {
  std::vector<Piece> pieces;  ///< lines and arcs, each starts exactly where the one before ends
  double deviation = 0.0;     ///< largest distance between both, units
};

/// Few tangent-continuous arcs and lines within `tolerance` (units) of a contour, corners kept: for
/// controllers and systems that know nothing else. Exact lines and arcs of the contour stay whole.
[[nodiscard]] Result<ArcsAlong> arcs_along(const Contour& contour, double tolerance);

}  // namespace obvid
