// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <variant>

#include "obvid/curve/contour.h"
#include "obvid/curve/internal/end_curvatures.h"

namespace obvid {
namespace {

/// The curve is its control points alone: weights that are all 1 stay 1.
bool has_equal_weights(const RationalBezier& piece) {
  const auto end = piece.weight.begin() + piece.degree + 1;
  return std::all_of(piece.weight.begin(), end, [](double w) { return w == 1.0; });
}

}  // namespace

void keep_joint_curvatures(Contour& contour) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    auto* piece = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (piece == nullptr) continue;
    const bool free_end = i + 1 < contour.pieces.size() && !contour.joints[i + 1].source;
    Element& end = contour.joints[i + 1].element;
    if (free_end) end.kappa = stored_curvature(*piece, false);
    keep_end_curvatures(*piece, {contour.joints[i].element.kappa, end.kappa},
                        has_equal_weights(*piece) ? InnerWeights::kFixed : InnerWeights::kFree);
  }
}

}  // namespace obvid
