// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/progress.h"
#include "obvid/core/result.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

struct ApproximatedSurface {
  NurbsSurface surface;
  double deviation = 0.0;  ///< largest distance of a point from its place, units
  double root_mean_square = 0.0;
};

/// Bicubic surface of least squares with as few knots as the tolerance needs (knots are added where
/// the error is largest). Points of the border stay within the tolerance like the others.
/// Errors: those of `interpolated`; E203 tolerance <= 0; E502 not reached (cannot happen for grids:
/// at worst the interpolating surface).
[[nodiscard]] Result<ApproximatedSurface> approximated(const PointGrid& grid, double tolerance,
                                                       const Progress& progress = {});

}  // namespace obvid
