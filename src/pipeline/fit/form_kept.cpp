// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "fit/form.h"
#include "obvid/contour/conics.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"

namespace obvid::pipeline_detail {
namespace {

/// Which way the curvature of a piece changes: pieces of drawings are cut at their vertices.
int direction_of_kept(const Piece& piece) {
  if (const auto* conic = std::get_if<RationalBezier>(&piece)) return conic_direction(*conic);
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) {
    return clothoid->kappa0 < clothoid->kappa1 ? 1 : clothoid->kappa0 > clothoid->kappa1 ? -1 : 0;
  }
  return 0;
}

}  // namespace

Contour form_kept(const Piece& piece, const std::vector<Vec2>& points, std::size_t from,
                  std::size_t to) {
  Contour out;
  Element first = element_at(piece, 0.0), last = element_at(piece, 1.0);
  first.point = points[from];
  last.point = points[to];
  // unwrapped along the piece, which turns by less than half a turn
  last.theta = nearest_angle(last.theta, first.theta);
  out.points = points;
  out.pieces.push_back(piece);
  out.joints = {{first, from}, {last, to}};
  out.runs = {{0, 0, direction_of_kept(piece)}};
  out.kept = {0};
  return out;
}

}  // namespace obvid::pipeline_detail
