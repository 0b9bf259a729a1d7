// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/drawn_spans.h"

#include <algorithm>
#include <cmath>

namespace obvid {
namespace {

/// What knots that are inserted make of a place, of the largest coordinate.
constexpr double kSpanRoundings = 64.0 * 0x1p-53;

}  // namespace

std::vector<Piece> drawn_spans(const NurbsCurve& curve) {
  double largest = 0.0;
  for (const Vec2 p : curve.points) {
    largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  const double same = kSpanRoundings * largest;
  std::vector<Piece> out;
  for (const BezierSpan& span : bezier_spans(curve)) {
    RationalBezier piece = span.piece;
    const auto end = static_cast<std::size_t>(piece.degree);
    bool point = true;
    for (std::size_t j = 1; j <= end; ++j) {
      Vec2& p = piece.offset[j];
      if (norm(p - piece.offset[0]) <= same) {
        if (j < end) p = piece.offset[0];
        continue;
      }
      point = false;
      if (norm(p - piece.offset[end]) <= same) p = piece.offset[end];
    }
    if (point) continue;
    if (piece.degree == 1) {
      out.emplace_back(LinePiece{piece.offset[0], piece.offset[1]});
    } else {
      out.emplace_back(piece);
    }
  }
  return out;
}

}  // namespace obvid
