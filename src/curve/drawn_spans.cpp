// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/drawn_spans.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

/// What knots that are inserted make of a place, of the largest coordinate.
constexpr double kSpanRoundings = 64.0 * 0x1p-53;
/// What is left of a difference of two coordinates of a file, of the largest of them.
constexpr double kFileRoundings = 4.0 * 0x1p-53;

double largest_coordinate(const std::vector<Vec2>& points) {
  double out = 0.0;
  for (const Vec2 p : points) out = std::max({out, std::abs(p.x), std::abs(p.y)});
  return out;
}

struct Spans {
  std::vector<RationalBezier> pieces;
  bool is_changed = false;  ///< control points were taken for an end that are not on it
};

/// Spans without those that are no more than a point: what is no farther than `same` from an end of
/// its span is that end.
Spans without_roundings(const NurbsCurve& curve, double same) {
  Spans out;
  for (const BezierSpan& span : bezier_spans(curve)) {
    RationalBezier piece = span.piece;
    const auto end = static_cast<std::size_t>(piece.degree);
    bool is_point = true;
    const auto take = [&](std::size_t j, Vec2 place) {
      out.is_changed = out.is_changed || !(piece.offset[j] == place);
      piece.offset[j] = place;
    };
    for (std::size_t j = 1; j <= end; ++j) {
      if (norm(piece.offset[j] - piece.offset[0]) <= same) {
        take(j, j < end ? piece.offset[0] : piece.offset[end]);
        continue;
      }
      is_point = false;
      if (norm(piece.offset[j] - piece.offset[end]) <= same) take(j, piece.offset[end]);
    }
    if (is_point) {
      out.is_changed = out.is_changed || !(piece.offset[end] == piece.offset[0]);
    } else {
      out.pieces.push_back(piece);
    }
  }
  return out;
}

/// With the digits that coordinates far from 0 have no room for.
Spans with_an_origin(NurbsCurve curve, double largest) {
  const Vec2 origin = curve.points.front();
  for (Vec2& p : curve.points) p = p - origin;
  Spans out = without_roundings(
      curve, kSpanRoundings * largest_coordinate(curve.points) + kFileRoundings * largest);
  for (RationalBezier& piece : out.pieces) piece.origin = origin;
  return out;
}

}  // namespace

std::vector<Piece> drawn_spans(const NurbsCurve& curve) {
  const double largest = largest_coordinate(curve.points);
  Spans spans = without_roundings(curve, kSpanRoundings * largest);
  if (spans.is_changed) {
    Spans finer = with_an_origin(curve, largest);
    if (!finer.is_changed) spans = std::move(finer);
  }
  std::vector<Piece> out;
  for (const RationalBezier& piece : spans.pieces) {
    if (piece.degree == 1) {
      out.emplace_back(LinePiece{start_point(piece), end_point(piece)});
    } else {
      out.emplace_back(piece);
    }
  }
  return out;
}

}  // namespace obvid
