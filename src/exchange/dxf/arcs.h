// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid::dxf {

/// Ellipse as centre + cos(E) p + sin(E) q; a circle when p and q are perpendicular and of one
/// length, and mirrored when q lies to the right of p.
struct EllipseFrame {
  Vec2 centre, p, q;
};

[[nodiscard]] bool is_circular(const EllipseFrame& frame);

/// How far an arc goes from one angle to the other, counter-clockwise, in (0, turn]. Ends that
/// differ by a whole turn, or by nothing, make the whole.
[[nodiscard]] double sweep_of(double from, double to, double turn);

/// Arc from E = `from` over `sweep` (rad, of either sign): arcs of less than half a turn, or
/// rational quadratics of a quarter turn at most.
void append_elliptic(const EllipseFrame& frame, double from, double sweep,
                     std::vector<Piece>& pieces);

/// Arc over a chord by the tangent of a quarter of its angle, positive to the left.
void append_bulge(Vec2 from, Vec2 to, double bulge, std::vector<Piece>& pieces);

}  // namespace obvid::dxf
