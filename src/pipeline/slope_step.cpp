// SPDX-License-Identifier: Apache-2.0
#include "slope_step.h"

#include <algorithm>
#include <cmath>

namespace obvid::pipeline_detail {

double slope_step_before(const std::vector<Piece>& pieces, std::size_t piece) {
  const std::size_t n = pieces.size(), before = (piece + n - 1) % n;
  const auto slope = [&](std::size_t i, double t) {
    const Piece& one = pieces[i];
    const bool even =
        std::holds_alternative<LinePiece>(one) || std::holds_alternative<ArcPiece>(one);
    return even ? 0.0 : curvature_rate(evaluate(one, t));
  };
  const auto mean = [&](std::size_t i) {
    const Jet a = evaluate(pieces[i], 0.0), b = evaluate(pieces[i], 1.0);
    const double change = std::abs(curvature(b) - curvature(a)) / norm(b.point - a.point);
    return std::isfinite(change) ? change : 0.0;
  };
  const double left = slope(before, 1.0), right = slope(piece, 0.0);
  const double scale = std::max({std::abs(slope(before, 0.0)), std::abs(left), std::abs(right),
                                 std::abs(slope(piece, 1.0)), mean(before), mean(piece)});
  return scale > 0.0 ? std::abs(right - left) / scale : 0.0;
}

}  // namespace obvid::pipeline_detail
