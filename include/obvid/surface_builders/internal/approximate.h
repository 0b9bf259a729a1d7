// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/run_context.h"
#include "obvid/core/result.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

struct ApproximatedSurface {
  NurbsSurface surface;
  /// Largest and root mean square distance of the points from the surface (nearest points of the
  /// surface near the points' parameters), units.
  double deviation = 0.0;
  double root_mean_square = 0.0;
  /// Largest distance of a point from the surface at its own parameters, units: never below
  /// `deviation`.
  double parametric_deviation = 0.0;
};

/// Bicubic surface of least squares (degree n - 1 along fewer than 4 points) whose distance from
/// each point is at most the tolerance, with few knots: spans are split where the error is largest,
/// in the direction that causes it, always at parameters of points; knots that the tolerance does
/// not need are taken away again. Parameters are averaged chord lengths. Points of the border stay within the tolerance like the others; a border row that is
/// one point, and opposite border rows that are the same (closed surface), stay so exactly.
/// What the data cannot carry becomes the interpolating surface. O(points) each step; the steps
/// grow with the logarithm of error / tolerance, for noise above the tolerance with the knots.
/// Errors: those of `interpolated`; E203 tolerance not > 0 and finite; E502 not reached (cannot
/// happen but for tolerances below rounding: at worst the surface interpolates).
[[nodiscard]] Result<ApproximatedSurface> approximated(const PointGrid& grid, double tolerance,
                                                       const RunContext& run = {});

}  // namespace obvid
