// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/bsplines/nurbs_of.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/curve/internal/joined_nurbs.h"

namespace obvid {

Result<ContourNurbs> nurbs_of(const Contour& contour, const NurbsOptions& options) {
  const bool clothoids =
      std::any_of(contour.pieces.begin(), contour.pieces.end(),
                  [](const Piece& piece) { return std::holds_alternative<ClothoidPiece>(piece); });
  if (clothoids && options.clothoid_tolerance) {
    const auto cubic = cubic_along(contour, *options.clothoid_tolerance);
    OBVID_TRY(cubic);
    return ContourNurbs{as_nurbs(cubic->spline), cubic->deviation};
  }
  if (options.joined) {
    auto joined = joined_nurbs(contour);
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
