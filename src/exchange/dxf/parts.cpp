// SPDX-License-Identifier: Apache-2.0
#include "dxf/parts.h"

#include <algorithm>
#include <cmath>

namespace obvid::exchange {
std::vector<BulgeVertex> bulge_vertices(const std::vector<Piece>& pieces, bool closed) {
  constexpr double kMostTurn = 3.0;  // of one arc, rad
  std::vector<BulgeVertex> out;
  for (const Piece& piece : pieces) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    const double turn = arc == nullptr ? 0.0 : arc->kappa * arc->length;
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kMostTurn)));
    const double bulge = std::tan(0.25 * turn / count);
    for (int k = 0; k < count; ++k) {
      out.push_back(
          {k == 0 ? start_point(piece) : evaluate(piece, double(k) / count).point, bulge});
    }
  }
  if (!closed && !pieces.empty()) out.push_back({end_point(pieces.back()), 0.0});
  return out;
}

}  // namespace obvid::exchange
