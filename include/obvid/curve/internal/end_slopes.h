// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/pieces.h"

namespace obvid {

/// Slopes of curvature, d kappa/ds, wanted at both ends of a piece, 1/unit^2.
struct WantedSlopes {
  double start = 0.0;
  double end = 0.0;
};

/// Slope of curvature at an end of a piece of degree 4, what the stored numbers say but for the
/// last bits.
[[nodiscard]] double stored_slope(const RationalBezier& piece, bool at_start);

/// Changes the inner weights so that the stored slopes of curvature are the wanted ones (degree 4,
/// positive weights; others stay). In a piece that turns by little, and whose curvature hardly
/// changes, half a unit of the last bit of a control point is much of the slope. A weight acts on
/// curvatures as they are, not on distances from a tangent: its last bit is as much less as the
/// piece turns (docs/methods/curve.md). A piece whose ends are right to 1e-9 of the larger slope,
/// and one that would need changes beyond 1e-9 of a weight (more than what rounding did), stays as
/// it is.
void keep_end_slopes(RationalBezier& piece, WantedSlopes wanted);

}  // namespace obvid
