// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/nurbs.h"

namespace obvid {
namespace {

bool joins(const RationalBezier& piece, const NurbsCurve& before) {
  const auto last = static_cast<std::size_t>(piece.degree);
  if (piece.origin != Vec2{} || piece.weight[0] != 1.0 || piece.weight[last] != 1.0) return false;
  if (before.points.empty()) return true;
  return piece.degree == before.degree && piece.offset[0] == before.points.back();
}

}  // namespace

std::optional<NurbsCurve> as_one_nurbs(const Contour& contour) {
  NurbsCurve curve;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const auto* piece = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (piece == nullptr || !joins(*piece, curve)) return std::nullopt;
    curve.degree = piece->degree;
    const auto p = static_cast<std::size_t>(piece->degree);
    for (std::size_t j = i == 0 ? 0 : 1; j <= p; ++j) {
      curve.points.push_back(piece->offset[j]);
      curve.weights.push_back(piece->weight[j]);
    }
    curve.knots.insert(curve.knots.end(), i == 0 ? p + 1 : p, static_cast<double>(i));
  }
  if (curve.points.empty()) return std::nullopt;
  if (contour.closed && curve.points.back() != curve.points.front()) return std::nullopt;
  curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(curve.degree) + 1,
                     static_cast<double>(contour.pieces.size()));
  return curve;
}

}  // namespace obvid
