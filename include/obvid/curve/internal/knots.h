// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/internal/homogeneous.h"

namespace obvid {

/// A spline line: knots and control points.
struct Line {
  int degree = 0;
  std::vector<double> knots;
  Polygon points;
};

/// `added` ascending, inside the domain. Boehm's insertion: convex combinations only.
[[nodiscard]] Line inserted(const Line& line, const std::vector<double>& added);
/// One degree more, each knot once more.
[[nodiscard]] Line raised(const Line& line);
/// Control points of degree `degree` on these knots when the knots alone are wanted.
[[nodiscard]] std::vector<double> raised_knots(const std::vector<double>& knots);

/// How often u stands among the knots.
[[nodiscard]] std::size_t multiplicity(const std::vector<double>& knots, double u);

/// Rules of clamped knots for `count` control points; `what` stands in the sentence.
[[nodiscard]] Result<void> check_knots(int degree, const std::vector<double>& knots,
                                       const char* what);

/// Numbers of control points (in the plane or in space) and weights, finite, weights > 0.
template <class V>
[[nodiscard]] Result<void> check_points(const std::vector<V>& points,
                                        const std::vector<double>& weights, std::size_t wanted);

/// Knots moved and scaled onto another range; ends exactly.
[[nodiscard]] std::vector<double> mapped(const std::vector<double>& knots, double from, double to);

}  // namespace obvid
