// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "obvid/curve/contour.h"

namespace obvid {

/// A piece that the contour's carrier does not have.
struct ForeignPiece {
  std::size_t index = 0;
  std::string what;  ///< "carrier beziers has parabolas and lines, not a polynomial of degree 5"
};

/// The first piece that is no curve of the kind that the carrier's name promises
/// (docs/carriers.md): its type, its degree and weights, whether a conic is an ellipse, whether a
/// rational quartic has the closed form of the spirals as far as its rounded numbers tell.
/// `baseline` promises nothing.
[[nodiscard]] std::optional<ForeignPiece> foreign_piece(const Contour& contour);

/// Whether pieces that were kept from a drawing are others than the carrier's: then its name says
/// nothing of them.
[[nodiscard]] bool keeps_foreign_pieces(const Contour& contour);

}  // namespace obvid
