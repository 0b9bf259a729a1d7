// SPDX-License-Identifier: Apache-2.0
#include "dxf/parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid::exchange {
namespace {

/// Joint after piece i, without what comes behind a corner.
Joint end_joint(const Contour& contour, std::size_t i) {
  Joint joint = contour.joints[(i + 1) % contour.joints.size()];
  joint.leaving.reset();
  return joint;
}

Contour part_from(const Contour& contour, std::size_t i) {
  Contour part;
  part.units = contour.units;
  part.carrier = contour.carrier;
  Joint first = contour.joints[i];
  if (first.leaving) first.element = *first.leaving;
  first.leaving.reset();
  part.joints.push_back(first);
  return part;
}

void append(Contour& part, const Contour& next) {
  part.pieces.insert(part.pieces.end(), next.pieces.begin(), next.pieces.end());
  part.joints.insert(part.joints.end(), next.joints.begin() + 1, next.joints.end());
}

}  // namespace

std::vector<Contour> smooth_parts(const Contour& contour) {
  std::vector<Contour> parts;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    if (i == 0 || contour.joints[i].leaving) parts.push_back(part_from(contour, i));
    parts.back().pieces.push_back(contour.pieces[i]);
    parts.back().joints.push_back(end_joint(contour, i));
  }
  if (parts.empty()) return parts;
  const bool smooth_seam = contour.closed && !contour.joints.front().leaving;
  if (smooth_seam && parts.size() > 1) {
    append(parts.back(), parts.front());
    parts.erase(parts.begin());
  } else if (smooth_seam) {
    parts.front().closed = true;
    parts.front().joints.pop_back();
  }
  for (Contour& part : parts) {
    part.points = {start_point(part.pieces.front()), end_point(part.pieces.back())};
  }
  return parts;
}

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
