// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/road_elements.h"

#include <fmt/format.h>

#include <array>
#include <utility>

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

RoadElement scaled(RoadElement e, double metres) {
  e.start = metres * e.start;
  e.end = metres * e.end;
  e.kappa0 /= metres;
  e.kappa1 /= metres;
  e.length *= metres;
  return e;
}

}  // namespace

std::optional<double> metres_in(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 9> kMetres = {
      {{"um", 1e-6},
       {"mm", 1e-3},
       {"cm", 1e-2},
       {"m", 1.0},
       {"km", 1e3},
       {"in", 0.0254},
       {"ft", 0.3048},
       {"yd", 0.9144},
       {"mi", 1609.344}}};
  for (const auto& [name, metres] : kMetres) {
    if (unit == name) return metres;
  }
  return std::nullopt;
}

Result<std::vector<RoadLine>> road_lines(const Contour& contour) {
  const auto metres = metres_in(contour.units);
  if (!metres) {
    return fail({ErrorCode::kBadOption, "the unit '" + contour.units + "' has no known length", "",
                 "form the contour with `fit --units mm` or another of um, mm, cm, m, km, in, ft",
                 -1, 0.0});
  }
  if (contour.pieces.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the contour has no pieces", "", "", -1, 0.0});
  }
  std::vector<RoadLine> lines;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const auto element = element_of(contour.pieces[i]);
    if (!element) {
      return fail({ErrorCode::kUnsupported,
                   "road formats know lines, arcs and clothoids, and this contour has other pieces",
                   fmt::format("piece {}", i + 1), "use `fit --carrier clothoids`", -1, 0.0});
    }
    const bool corner = i < contour.joints.size() && contour.joints[i].leaving.has_value();
    if (i == 0 || corner) lines.emplace_back();
    RoadLine& line = lines.back();
    line.elements.push_back(scaled(*element, *metres));
    line.elements.back().s = line.length;
    line.length += line.elements.back().length;
  }
  return lines;
}

}  // namespace obvid
