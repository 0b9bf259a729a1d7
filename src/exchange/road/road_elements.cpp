// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/road/road_elements.h"

#include <fmt/format.h>

namespace obvid {
namespace {

/// The piece in its own unit; nothing for Beziers.
std::optional<RoadElement> element_of(const Piece& piece) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) {
    const Vec2 step = line->end - line->start;
    return RoadElement{0.0, line->start, line->end, heading(step), 0.0, 0.0, norm(step)};
  }
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    return RoadElement{0.0, arc->start, arc->end, arc->theta0, arc->kappa, arc->kappa, arc->length};
  }
  if (const auto* c = std::get_if<ClothoidPiece>(&piece)) {
    return RoadElement{0.0, c->start, c->end, c->theta0, c->kappa0, c->kappa1, c->length};
  }
  return std::nullopt;
}

RoadElement scaled(RoadElement e, double ratio) {
  e.start = ratio * e.start;
  e.end = ratio * e.end;
  e.kappa0 /= ratio;
  e.kappa1 /= ratio;
  e.length *= ratio;
  return e;
}

}  // namespace

Result<std::vector<RoadLine>> road_lines(const Contour& contour, std::string_view unit) {
  const auto ratio = unit_ratio(contour.units, unit, "road formats");
  OBVID_TRY(ratio);
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  std::vector<RoadLine> lines;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const auto element = element_of(contour.pieces[i]);
    if (!element) {
      return error(ErrorCode::kUnsupported,
                   "road formats know lines, arcs and clothoids, and this contour has other pieces")
          .where(fmt::format("piece {}", i + 1))
          .hint(
              "use `fit --carrier clothoids`, with --drawing points where a drawing has other "
              "curves");
    }
    const bool corner = i < contour.joints.size() && is_corner(contour.joints[i]);
    if (i == 0 || corner) lines.emplace_back();
    RoadLine& line = lines.back();
    line.elements.push_back(scaled(*element, *ratio));
    line.elements.back().s = line.length;
    line.length += line.elements.back().length;
  }
  return lines;
}

}  // namespace obvid
