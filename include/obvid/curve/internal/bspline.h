// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/nurbs.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// One knot span of a NURBS curve as a Bezier piece.
struct BezierSpan {
  double from = 0.0;  ///< knot at its start
  double to = 0.0;    ///< knot at its end
  RationalBezier piece;
};

/// The curve cut at its knots, spans of no length left out: the same curve exactly, apart from the
/// rounding of the control points. Empty when the degree is not in 1..7, or the numbers of knots,
/// points and weights do not belong together. Cost O(degree^3) per span.
[[nodiscard]] std::vector<BezierSpan> bezier_spans(const NurbsCurve& curve);

/// Point and derivatives by the parameter `u` of the knots; outside them the nearest span goes on.
/// For many parameters cut the curve once with `bezier_spans`.
[[nodiscard]] Jet evaluate(const NurbsCurve& curve, double u);

}  // namespace obvid
