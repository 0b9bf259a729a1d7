// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "obvid/geom/element.h"

namespace obvid::bsplines {

/// Control points of a quintic Bezier piece.
using Quintic = std::array<Vec2, 6>;

/// The quintic over `length` with unit speed, no tangential acceleration, and the given points,
/// headings and curvatures at its ends.
[[nodiscard]] Quintic hermite_quintic(const Element& start, const Element& end, double length);

[[nodiscard]] Vec2 point_at(const Quintic& q, double t);

/// +1 when the signed curvature increases strictly over the piece, -1 when it decreases, 0 when
/// neither shows in doubles.
[[nodiscard]] int curvature_direction(const Quintic& q);

}  // namespace obvid::bsplines
