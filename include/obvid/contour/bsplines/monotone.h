// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstdint>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

/// A polynomial B-spline in place of a contour of spirals.
struct MonotoneSpline {
  NurbsCurve curve;                    ///< degree 5, all weights 1, inner knots of multiplicity 3:
                                       ///< C2, parameter nearly arc length; 3 spans + 3 points
  std::vector<RationalBezier> spans;   ///< the same, one Bezier piece per knot span
  std::vector<Element> elements;       ///< at the knots; headings unwrapped inside each piece
  std::vector<std::int8_t> direction;  ///< per span: +1 curvature increases, -1, 0 straight
  double deviation = 0.0;  ///< largest distance between points of equal arc length, as measured at
                           ///< 24 places of each span or more: an upper estimate of the distance
                           ///< between both curves, not a proved bound
};

/// Monotone polynomial B-spline within `tolerance` (units) of a contour with the same vertices:
/// each span meets the contour at both ends with point, tangent and curvature (a quintic Hermite in
/// arc length), is as long as tolerance and monotone curvature let it be, and keeps inside one run.
/// Input points that are no knots are passed within the tolerance only.
///
/// Curvature is monotone on every span by the signs of the Bernstein coefficients of its derivative
/// in doubles; since the ends have the contour's own curvatures, the spline has its vertices and no
/// others. The proof of the rounded numbers is for `certify`.
/// Errors: E203 a tolerance that is not greater than 0; E310, naming the piece, a corner or an arc
/// (no polynomial has constant curvature); E405 where no span, however short, is monotone in
/// doubles
/// (`index`: the piece).
/// Cost O(n) plus about 30 trials per span.
[[nodiscard]] Result<MonotoneSpline> monotone_spline(const Contour& spiral, double tolerance);
/// The same under watch; error E103 when it was cancelled.
[[nodiscard]] Result<MonotoneSpline> monotone_spline(const Contour& spiral, double tolerance,
                                                     Watch& watch);

}  // namespace obvid
