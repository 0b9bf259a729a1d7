// SPDX-License-Identifier: Apache-2.0
#include "pieces.h"

namespace judge {

Point stored_start(const Piece& piece) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) return bezier->rounded.front();
  if (const auto* arc = std::get_if<Arc>(&piece)) return arc->start;
  if (const auto* clothoid = std::get_if<Clothoid>(&piece)) return clothoid->start;
  return std::get<Line>(piece).start;
}

Point stored_end(const Piece& piece) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) return bezier->rounded.back();
  if (const auto* arc = std::get_if<Arc>(&piece)) return arc->end;
  if (const auto* clothoid = std::get_if<Clothoid>(&piece)) return clothoid->end;
  return std::get<Line>(piece).end;
}

Piece scaled(const Piece& piece, double factor) {
  const auto times = [factor](Point p) { return Point{p.x * factor, p.y * factor}; };
  if (const auto* line = std::get_if<Line>(&piece)) {
    return Line{times(line->start), times(line->end)};
  }
  if (const auto* arc = std::get_if<Arc>(&piece)) {
    return Arc{times(arc->start), times(arc->end), arc->theta0, arc->kappa / factor,
               arc->length * factor};
  }
  if (const auto* one = std::get_if<Clothoid>(&piece)) {
    return Clothoid{times(one->start),    times(one->end),      one->theta0,
                    one->kappa0 / factor, one->kappa1 / factor, one->length * factor};
  }
  Bezier out = std::get<Bezier>(piece);
  out.origin = times(out.origin);
  for (Point& p : out.offset) p = times(p);
  for (Point& p : out.rounded) p = times(p);
  return out;
}

const char* type_name(const Piece& piece) {
  constexpr const char* kNames[] = {"line", "arc", "clothoid", "bezier"};
  return kNames[piece.index()];
}

}  // namespace judge
