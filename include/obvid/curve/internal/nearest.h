// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/pieces.h"

namespace obvid {

/// Parameter in [0, 1] of a point of the piece that is nearest to p among its neighbours, searched
/// from `t` on. Lines and arcs (of less than a turn): the nearest of all. Others: Newton's method,
/// kept between places where the distance still falls and rises again; a piece that bends about p
/// has several such points.
[[nodiscard]] double nearest_parameter(const Piece& piece, Vec2 p, double t = 0.5);

}  // namespace obvid
