// SPDX-License-Identifier: Apache-2.0
#include "files/contour_nurbs.h"

#include <algorithm>
#include <utility>

#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/curve/internal/joined_nurbs.h"

namespace obvid::pipeline_detail {

Result<ContourNurbs> contour_nurbs(const Contour& contour, double tolerance) {
  const bool clothoids =
      std::any_of(contour.pieces.begin(), contour.pieces.end(),
                  [](const Piece& piece) { return std::holds_alternative<ClothoidPiece>(piece); });
  if (!clothoids) {
    auto joined = joined_nurbs(contour);
    if (!joined) return fail(joined.error());
    return ContourNurbs{std::move(*joined), 0.0};
  }
  const auto cubic = cubic_along(contour, tolerance);
  if (!cubic) return fail(cubic.error());
  return ContourNurbs{as_nurbs(cubic->spline), cubic->deviation};
}

}  // namespace obvid::pipeline_detail
