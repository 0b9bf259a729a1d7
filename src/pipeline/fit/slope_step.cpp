// SPDX-License-Identifier: Apache-2.0
#include "fit/slope_step.h"

#include <algorithm>
#include <cmath>

namespace obvid::pipeline_detail {

namespace {

/// Slopes of curvature of a piece.
struct PieceSlopes {
  double start = 0.0, end = 0.0;
  double mean = 0.0;  ///< over the chord; 0 where it has no bound
};

PieceSlopes slopes_of(const Piece& piece) {
  const Jet a = evaluate(piece, 0.0), b = evaluate(piece, 1.0);
  PieceSlopes out;
  const double mean = std::abs(curvature(b) - curvature(a)) / norm(b.point - a.point);
  if (std::isfinite(mean)) out.mean = mean;
  const bool even =
      std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
  if (even) return out;
  out.start = curvature_rate(a);
  out.end = curvature_rate(b);
  return out;
}

double step_between(const PieceSlopes& before, const PieceSlopes& after) {
  const double scale =
      std::max({std::abs(before.start), std::abs(before.end), std::abs(after.start),
                std::abs(after.end), before.mean, after.mean});
  return scale > 0.0 ? std::abs(after.start - before.end) / scale : 0.0;
}

}  // namespace

double slope_step_before(const std::vector<Piece>& pieces, std::size_t piece) {
  const std::size_t n = pieces.size();
  return step_between(slopes_of(pieces[(piece + n - 1) % n]), slopes_of(pieces[piece]));
}

double largest_slope_step(const std::vector<Piece>& pieces, bool loop) {
  if (pieces.empty()) return 0.0;
  double largest = 0.0;
  PieceSlopes before = slopes_of(loop ? pieces.back() : pieces.front());
  for (std::size_t i = loop ? 0 : 1; i < pieces.size(); ++i) {
    const PieceSlopes after = slopes_of(pieces[i]);
    largest = std::max(largest, step_between(before, after));
    before = after;
  }
  return largest;
}

}  // namespace obvid::pipeline_detail
