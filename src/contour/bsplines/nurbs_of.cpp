// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/bsplines/nurbs_of.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/curve/internal/joined_nurbs.h"
#include "obvid/curve/internal/smooth_parts.h"

namespace obvid {
namespace {

/// `next` begins where `curve` ends: there the curve has a corner, with a knot as often as its
/// degree.
void append(NurbsCurve& curve, const NurbsCurve& next) {
  const auto degree = static_cast<std::ptrdiff_t>(curve.degree);
  const double shift = curve.knots.back() - next.knots.front();
  curve.knots.pop_back();
  for (auto knot = next.knots.begin() + degree + 1; knot != next.knots.end(); ++knot) {
    curve.knots.push_back(*knot + shift);
  }
  curve.points.insert(curve.points.end(), next.points.begin() + 1, next.points.end());
  curve.weights.insert(curve.weights.end(), next.weights.begin() + 1, next.weights.end());
}

/// C2 cubics along the parts between corners.
Result<ContourNurbs> cubics_along(const Contour& contour, double tolerance, Watch* watch) {
  ContourNurbs out;
  for (const Contour& part : smooth_parts(contour)) {
    const auto cubic = cubic_along(part, tolerance, watch);
    OBVID_TRY(cubic);
    const NurbsCurve curve = as_nurbs(cubic->spline);
    if (out.curve.points.empty()) {
      out.curve = curve;
    } else {
      append(out.curve, curve);
    }
    out.deviation = std::max(out.deviation, cubic->deviation);
  }
  return out;
}

}  // namespace

Result<ContourNurbs> nurbs_of(const Contour& contour, const NurbsOptions& options, Watch* watch) {
  const bool clothoids =
      std::any_of(contour.pieces.begin(), contour.pieces.end(),
                  [](const Piece& piece) { return std::holds_alternative<ClothoidPiece>(piece); });
  if (clothoids && options.clothoid_tolerance) {
    return cubics_along(contour, *options.clothoid_tolerance, watch);
  }
  if (options.joined) {
    auto joined = joined_nurbs(contour, watch);
    OBVID_TRY(joined);
    return ContourNurbs{std::move(*joined), 0.0};
  }
  auto curve = as_one_nurbs(contour);
  if (!curve) {
    return error(ErrorCode::kUnsupported, "the pieces are not one NURBS curve as they stand")
        .hint("take the joined one");
  }
  return ContourNurbs{std::move(*curve), 0.0};
}

}  // namespace obvid
