// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/chain/chain.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// The spiral with given end points, headings and curvatures in closed form (theory 6.1): the
/// Moebius image of a hyperbola arc, as a rational quartic Bezier with end weights scaled to 1 at
/// the end. `direction` is +1 when the signed curvature increases from start to end, -1 when it
/// decreases.
///
/// Nothing when the closed form does not apply: `cone_margin(link, direction, kClosedForm)` must be
/// positive, and the weights come out positive only for pieces that do not turn too far.
/// End points are met exactly, headings and curvatures to rounding relative to the chord. Strict
/// monotonicity holds in exact arithmetic; it is for `certify` to prove it of the rounded numbers.
[[nodiscard]] std::optional<RationalBezier> spiral_piece(const LinkState& link, int direction,
                                                         Vec2 start, Vec2 end);

}  // namespace obvid
