// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/lines_and_arcs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "obvid/geom/internal/circle.h"

namespace obvid {
namespace {

constexpr std::size_t kFewestPoints = 4;

std::optional<LineOrArc> shape_of(const Piece& piece) {
  LineOrArc out;
  if (const auto* line = std::get_if<LinePiece>(&piece)) {
    const Vec2 along = line->end - line->start;
    out.theta = std::atan2(along.y, along.x);
    out.length = norm(along);
    return out;
  }
  const auto* arc = std::get_if<ArcPiece>(&piece);
  if (arc == nullptr) return std::nullopt;
  out.theta = arc->theta0;
  out.kappa = arc->kappa;
  out.length = arc->length;
  out.centre = arc->start + (1.0 / arc->kappa) * left_normal(unit_at(arc->theta0));
  return out;
}

}  // namespace

std::vector<LineOrArc> lines_and_arcs(const Contour& contour) {
  std::vector<LineOrArc> out;
  if (follows_spirals(contour.carrier)) return out;
  const std::size_t n = contour.points.size(), pieces = contour.pieces.size();
  for (std::size_t k = 0; k < pieces; ++k) {
    if (std::find(contour.kept.begin(), contour.kept.end(), k) != contour.kept.end()) continue;
    const auto from = contour.joints[k].source,
               to = contour.joints[contour.closed ? (k + 1) % pieces : k + 1].source;
    if (!from || !to) continue;
    const std::size_t over = *to > *from ? *to - *from : *to + n - *from;
    if (over + 1 < kFewestPoints || (!contour.closed && *to < *from)) continue;
    auto one = shape_of(contour.pieces[k]);
    if (!one) continue;
    one->from = *from;
    one->to = *to;
    const Vec2 start = start_point(contour.pieces[k]);
    for (std::size_t i = 0; i <= over; ++i) {
      one->off = std::max(one->off, distance_from_circle(start, one->theta, one->kappa,
                                                         contour.points[(*from + i) % n]));
    }
    out.push_back(*one);
  }
  return out;
}

}  // namespace obvid
