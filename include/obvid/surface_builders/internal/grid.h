// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/surface/nurbs_surface.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

/// How parameters of a row are spread.
enum class Spread {
  kChord,        ///< by chord lengths, averaged over the rows
  kCentripetal,  ///< by their square roots, averaged
  kUniform,
};

/// Point surface: the bicubic NURBS surface, C2 both ways, through all points of the grid (third
/// derivative continuous at the second and last but one knot; of 3 points a parabola, of 2 a line).
/// Cost O(points). Rows that shrink to a point (poles) are allowed as long as the averages ascend.
/// Errors: E201 numbers that do not belong together, E303, E304 fewer than 2 x 2 points, E309 a row
/// or column of points that all stand still (`index`: which).
[[nodiscard]] Result<NurbsSurface> interpolated(const PointGrid& grid,
                                                Spread spread = Spread::kChord);

/// CV surface: the points of the grid are the control points; uniform clamped knots, degrees at
/// most one less than the numbers of points.
[[nodiscard]] Result<NurbsSurface> from_control_points(const PointGrid& grid, int degree_u = 3,
                                                       int degree_v = 3);

/// Averaged parameters in [0, 1] of the points of a row (`along_u`) or of the rows.
[[nodiscard]] Result<std::vector<double>> grid_parameters(const PointGrid& grid, bool along_u,
                                                          Spread spread);

}  // namespace obvid
