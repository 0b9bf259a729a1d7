// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "obvid/curve/nurbs.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Cubic spline by its points and derivatives at ascending knots, at least two.
struct CubicSpline {
  std::vector<double> knots;
  std::vector<Vec2> points;
  std::vector<Vec2> slopes;  ///< derivatives of the point by the parameter of the knots
};

/// Point and derivatives at parameter `u`; outside the knots the end pieces go on. O(log n).
[[nodiscard]] Jet evaluate(const CubicSpline& spline, double u);

/// Points at ascending parameters, written to `out` (of the same size). Descending ones are found
/// too, but cost a search each. O(n + m).
void evaluate_sorted(const CubicSpline& spline, std::span<const double> u, std::span<Vec2> out);

/// One polynomial cubic Bezier piece per knot span.
[[nodiscard]] std::vector<RationalBezier> bezier_pieces(const CubicSpline& spline);

/// The spline as B-spline with simple inner knots, n + 2 control points. Exactly the same curve
/// only if its second derivative is continuous.
[[nodiscard]] NurbsCurve as_nurbs(const CubicSpline& spline);

}  // namespace obvid
