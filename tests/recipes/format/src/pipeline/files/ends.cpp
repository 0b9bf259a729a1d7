// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: the ends of all pieces, a line of text each.
#include <fmt/format.h>

#include "files/format_writers.h"

namespace obvid::pipeline_detail {

Result<Exported> contour_as_ends(const ContourExport& e) {
  std::string text;
  for (const Piece& piece : e.contour.pieces) {
    const Vec2 a = evaluate(piece, 0.0).point, b = evaluate(piece, 1.0).point;
    text += fmt::format("{} {} {} {}\n", a.x, a.y, b.x, b.y);
  }
  return Exported{{{"", std::move(text)}}, {}, {}};
}

}  // namespace obvid::pipeline_detail
