// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/contour/bsplines.h"

namespace obvid::bsplines {

/// Knots of a series from 0 on, one per point. Errors: E304 fewer than `fewest` points, E402
/// neighbours that coincide.
[[nodiscard]] Result<std::vector<double>> spline_knots(const std::vector<Vec2>& points,
                                                       SplineParameter parameter,
                                                       std::size_t fewest);

}  // namespace obvid::bsplines
