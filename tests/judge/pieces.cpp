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

const char* type_name(const Piece& piece) {
  constexpr const char* kNames[] = {"line", "arc", "clothoid", "bezier"};
  return kNames[piece.index()];
}

}  // namespace judge
