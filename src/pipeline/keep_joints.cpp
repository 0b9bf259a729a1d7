// SPDX-License-Identifier: Apache-2.0
#include "keep_joints.h"

#include <algorithm>
#include <cmath>

#include "obvid/curve/end_curvatures.h"

namespace obvid::pipeline_detail {
namespace {

/// The curve is its control points alone: weights that are all 1 stay 1.
bool polynomial(const RationalBezier& piece) {
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
                        polynomial(*piece) ? InnerWeights::kFixed : InnerWeights::kFree);
  }
}

void chain_conic_weights(Contour& contour) {
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    auto* conic = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (conic == nullptr || conic->degree != 2) continue;
    Element& start = contour.joints[i].element;
    const double stored = stored_curvature(*conic, true);
    const double ratio = i > 0 ? stored / start.kappa : 1.0;
    if (ratio > 0.0 && std::isfinite(ratio)) conic->weight[1] *= std::sqrt(ratio);
    if (i == 0) start.kappa = stored;
    contour.joints[i + 1].element.kappa = stored_curvature(*conic, false);
  }
}

}  // namespace obvid::pipeline_detail
