// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid::arcs {

/// Part of a contour without corners: pieces [first, end).
struct Stretch {
  std::size_t first = 0;
  std::size_t end = 0;
  bool exact = false;   ///< one line or arc
  bool closed = false;  ///< the whole of a closed contour that is smooth at its start too
};

/// Places along a contour by one number near to arc length: each piece is cut at even steps of its
/// parameter, and the parameter runs evenly over the length of each part.
class Track {
 public:
  explicit Track(const Contour& contour);

  struct Place {
    std::size_t piece = 0;
    double t = 0.0;
  };

  [[nodiscard]] const Piece& piece(std::size_t i) const { return contour_.pieces[i]; }
  [[nodiscard]] double start_of(std::size_t piece) const { return cell_[kCells * piece]; }

  [[nodiscard]] double length() const { return cell_.back(); }

  /// `from_left`: at a joint the end of the piece before it.
  [[nodiscard]] Place place(double s, bool from_left) const;
  [[nodiscard]] Jet jet(double s, bool from_left) const;

  /// Maximal parts without corners; each exact line or arc is a part of its own.
  [[nodiscard]] std::vector<Stretch> stretches() const;

  /// Places strictly inside a stretch where the curvature begins to change the other way.
  [[nodiscard]] std::vector<double> vertices(const Stretch& stretch) const;

 private:
  [[nodiscard]] bool corner_before(std::size_t piece) const;

  const Contour& contour_;
  static constexpr std::size_t kCells = 8;  ///< of a piece
  std::vector<double> cell_;                ///< start of every cell, and the end
};

/// Whether a piece is a line or a circle arc. Clothoids of constant curvature are.
[[nodiscard]] bool is_circular(const Piece& piece);
/// Such a piece as LinePiece or ArcPiece.
[[nodiscard]] Piece as_circular(const Piece& piece);

}  // namespace obvid::arcs
