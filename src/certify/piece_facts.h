// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// What the proof of one piece yields beyond its verdict.
struct PieceFacts {
  PieceProof proof;
  bool turns_below_pi = false;  ///< the hodograph stays within a half plane: no winding
  int first_change = 0;         ///< sign of d kappa before a vertex (kHasVertex), else its sign
  int last_change = 0;
};

/// A strict sign, and the parameter from which on it was found.
struct SignFrom {
  int sign = 0;
  double t = 0.0;
};

[[nodiscard]] PieceFacts examine_piece(const Piece& piece);

/// The same in exact integers, for the pieces that floating point cannot decide (or hides: the
/// tests call it to cross-check). Slow, about a millisecond.
[[nodiscard]] PieceFacts examine_exactly(const RationalBezier& piece);

/// How the curvature of a piece changes from its start on: +1 where it grows, -1 where it falls,
/// nothing twice in a row. Double-doubles, and exact integers where these leave anything open;
/// changes closer to each other than 2^-40 of the parameter count as two or as none.
[[nodiscard]] std::vector<SignFrom> curvature_changes(const RationalBezier& piece);

/// Likewise how a piece of positive weights bends: +1 to the left, -1 to the right.
[[nodiscard]] std::vector<SignFrom> curvature_signs(const RationalBezier& piece);

/// The same in exact integers.
[[nodiscard]] std::vector<SignFrom> curvature_changes_exactly(const RationalBezier& piece);
[[nodiscard]] std::vector<SignFrom> curvature_signs_exactly(const RationalBezier& piece);

/// Whether three control points lie exactly on one line.
[[nodiscard]] bool collinear_exactly(const RationalBezier& piece, std::size_t a, std::size_t b,
                                     std::size_t c);

/// In double-double numbers only; undecided where those do not suffice.
[[nodiscard]] PieceFacts examine_in_double_double(const RationalBezier& piece);

/// In doubles only; undecided where those do not suffice.
[[nodiscard]] PieceFacts examine_in_doubles(const RationalBezier& piece);

}  // namespace obvid
