// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"
#include "obvid/curve/internal/contour_path.h"

namespace obvid::arcs {

/// Part of a contour without corners: pieces [first, end).
struct SmoothPart {
  std::size_t first = 0;
  std::size_t end = 0;
  bool exact = false;   ///< one line or arc
  bool closed = false;  ///< the whole of a closed contour that is smooth at its start too
};

/// A contour by its arc length, and its parts. The contour must outlive it.
class Track {
 public:
  explicit Track(const Contour& contour) : contour_(contour), path_(contour.pieces, kAccuracy) {}

  using Place = ContourPath::Parameter;

  [[nodiscard]] const Piece& piece(std::size_t i) const { return contour_.pieces[i]; }
  [[nodiscard]] double start_of(std::size_t piece) const { return path_.joint(piece); }

  [[nodiscard]] double length() const { return path_.length(); }

  /// `from_left`: at a joint the end of the piece before it.
  [[nodiscard]] Place place(double s, bool from_left) const {
    return path_.parameter(s, from_left);
  }
  [[nodiscard]] Jet jet(double s, bool from_left) const { return path_.jet(s, from_left); }

  /// Maximal parts without corners; each exact line or arc is a part of its own.
  [[nodiscard]] std::vector<SmoothPart> stretches() const;

  /// Places strictly inside a stretch where the curvature begins to change the other way.
  [[nodiscard]] std::vector<double> vertices(const SmoothPart& stretch) const;

 private:
  [[nodiscard]] bool corner_before(std::size_t piece) const;

  const Contour& contour_;
  /// Of a piece: places are tried, and what is built on them is measured.
  static constexpr double kAccuracy = 1e-6;
  ContourPath path_;
};

/// Whether a piece is a line or a circle arc. Clothoids of constant curvature are.
[[nodiscard]] bool is_circular(const Piece& piece);
/// Such a piece as LinePiece or ArcPiece.
[[nodiscard]] Piece as_circular(const Piece& piece);

}  // namespace obvid::arcs
