// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: each spiral as two rational quartics, cut in the middle of its parameter.
#include <variant>

#include "obvid/contour/common/internal/carried_parts.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/runs.h"

namespace obvid::contour_detail {

Result<Carried> carry_halves(const Contour& spirals, const CarryOptions&) {
  Carried out{like(spirals, Carrier::kHalves)};
  std::vector<int> direction;
  const std::vector<int> whole = piece_directions(spirals);
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    const Piece& piece = spirals.pieces[i];
    out.contour.joints.push_back(spirals.joints[i]);
    direction.push_back(whole[i]);
    const auto* spiral = std::get_if<RationalBezier>(&piece);
    if (spiral == nullptr) {
      out.contour.pieces.push_back(piece);
      continue;
    }
    const auto halves = split(*spiral, 0.5);
    out.contour.pieces.emplace_back(halves[0]);
    const Element middle = element_near(piece, 0.5, spirals.joints[i].element.theta);
    out.contour.joints.push_back({middle, std::nullopt});
    out.contour.pieces.emplace_back(halves[1]);
    direction.push_back(whole[i]);
  }
  out.contour.joints.push_back(spirals.joints.back());
  out.contour.runs = collect_runs(direction);
  keep_joint_curvatures(out.contour);
  return out;
}

}  // namespace obvid::contour_detail
