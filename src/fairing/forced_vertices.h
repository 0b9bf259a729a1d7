// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid::fairing_detail {

/// Vertices that every smooth curve has which passes each point within its reach.
///
/// The difference of the curvatures of the circles through points a, b, c and b, c, d is an average
/// of the rate of curvature between a and d, with a B-spline of degree 2 on these points as weight.
/// Averages with the B-splines of one knot sequence change sign at most as often as what they
/// average (Schoenberg 1967: variation diminishing). So the changes of sign among those differences
/// that exceed what the reaches can do count vertices. Any subsequence of the points may be the
/// knots: the best one is found by dynamic programming over strides. Exact for graphs of small
/// slope, to first order in (reach / chord); O(n).
[[nodiscard]] int forced_vertices(const std::vector<Vec2>& points,
                                  const std::vector<double>& reach);

}  // namespace obvid::fairing_detail
