// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "obvid/contour/bsplines.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/contour/common/internal/carried_parts.h"

namespace obvid::contour_detail {
Result<Carried> carry_cubic(const Contour& spirals, const CarryOptions& options) {
  if (only<LinePiece>(spirals)) return as_they_are(spirals, Carrier::kCubic);
  Contour whole = spirals;
  whole.closed = options.loop;
  const auto along = cubic_along(whole, options.tolerance, &options.watch);
  if (!along) return at_point(along.error(), spirals, along.error().index, kOtherCarriers);
  Carried out{like(spirals, Carrier::kCubic), {}};
  const std::vector<RationalBezier> pieces = bezier_pieces(along->spline);
  const auto end_joint = [&](const RationalBezier& piece, double t, const Joint& end) {
    return Joint{element_near(Piece{piece}, t, end.element.theta), end.source, {}};
  };
  out.contour.joints.push_back(end_joint(pieces.front(), 0.0, spirals.joints.front()));
  add_free_pieces(pieces, out.contour);
  out.contour.joints.push_back(end_joint(pieces.back(), 1.0, spirals.joints.back()));
  return out;
}

}  // namespace obvid::contour_detail
