// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/chain/internal/chain.h"
#include "obvid/chain/internal/spiral_shape.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Appends the spiral with given end points, headings and curvatures in closed form
/// (docs/methods/chain.md, 1):
/// the Moebius image of a hyperbola arc, as a rational quartic Bezier with both end weights 1.
/// `direction` is +1 when the signed curvature increases from start to end, -1 when it decreases.
/// Where the piece turns so far that a weight is not positive, or by more than about 140 degrees,
/// the same curve is appended as several Bezier pieces.
///
/// Returns false, appending nothing, when the closed form does not apply: it needs
/// `cone_margin(link, direction, kClosedForm) > 0`.
/// End points are met exactly, headings and curvatures to rounding relative to the chord. Strict
/// monotonicity holds in exact arithmetic; it is for `certify` to prove it of the rounded numbers.
[[nodiscard]] bool append_spiral(const LinkState& link, int direction, Vec2 start, Vec2 end,
                                 std::vector<RationalBezier>& pieces);

/// The same in any form (docs/methods/g3.md). All but kOneSided need no more than that some spiral
/// exists, `cone_margin(link, direction, kSpiral) > 0`; those at rest need more
/// (`spiral_slopes`), and false says too that there is none.
[[nodiscard]] bool append_spiral(const LinkState& link, int direction, SpiralForm form, Vec2 start,
                                 Vec2 end, std::vector<RationalBezier>& pieces);

}  // namespace obvid
