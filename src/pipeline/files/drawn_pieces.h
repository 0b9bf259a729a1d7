// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/exchange/drawing.h"

namespace obvid::pipeline_detail {

/// A piece of a drawing, and whether it stays as it is.
struct DrawnPiece {
  Piece piece;
  bool kept = false;
};

/// The pieces of a curve that stay, cut where they turn by half a turn and at the vertices of
/// ellipses, and those that do not. What is straight is a line, whatever it was drawn as; lines that
/// are chords of a curve do not stay, unless `all_lines`.
[[nodiscard]] std::vector<DrawnPiece> drawn_pieces(const DrawnCurve& curve, bool all_lines);

/// Moves the ends of neighbours onto each other. Arcs stay where they are beside lines; other pieces
/// are turned and scaled onto their new ends. The largest gap that was too wide for that, as part of
/// the size of the curve; 0 when all was joined.
[[nodiscard]] double join_ends(std::vector<DrawnPiece>& pieces, bool closed, double size);

/// Arcs of ellipses that end in vertices are moved by rounding, up to 1e-8 of themselves where the
/// ellipse is nearly round, so that no vertex lies inside; where that does not help they do not stay.
void open_vertices(std::vector<DrawnPiece>& pieces);

}  // namespace obvid::pipeline_detail
