// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/box.h"

namespace obvid {

/// Makes the box hold the piece: its ends, and the places in between where it turns back along an
/// axis. To rounding, but for such places that lie nearer to each other than a 64th of the piece.
void add_piece(Box2& box, const Piece& piece);

/// Diagonal of the box of five places on each piece, its ends among them: a scale for tolerances,
/// not the size of the curve.
[[nodiscard]] double about_size(const std::vector<Piece>& pieces);

}  // namespace obvid
