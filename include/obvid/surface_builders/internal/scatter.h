// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/vec3.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid {

struct ScatterOptions {
  double tolerance = 0.0;      ///< units along `up`, > 0
  Vec3 up{0.0, 0.0, 1.0};      ///< direction of the heights, any length
  double steepest = 0.0;       ///< rad, in (0, pi / 2): what neighbours may force
  bool drop_outliers = false;  ///< left out, in place of named alone
};

/// A point that its neighbours pass by.
struct ScatterOutlier {
  std::size_t point = 0;
  double off = 0.0;  ///< units along `up`: the point above what its neighbours say
};

/// Parts of the rectangle that have no points near them, measured on a raster.
struct EmptyParts {
  double reach = 0.0;  ///< units in the plane: farther than this from every point is without data
  double share = 0.0;  ///< of the raster's places
  double farthest =
      0.0;     ///< units in the plane: largest distance of a place from its nearest point
  Vec3 where;  ///< that place, on the surface
  std::size_t raster = 0;  ///< places
};

struct ScatteredSurface {
  NurbsSurface surface;  ///< bicubic over [0, 1] x [0, 1]
  Frame plane;           ///< x along u, y along v, normal `up`; origin: corner (0, 0) at height 0
  double width = 0.0, depth = 0.0;       ///< units, of the rectangle
  std::vector<ScatterOutlier> outliers;  ///< by their numbers
  std::size_t used = 0;                  ///< points
  /// Largest and root mean square distance of the used points from the surface along `up`, units.
  double deviation = 0.0, root_mean_square = 0.0;
  std::size_t farthest = 0;  ///< the point that has the largest
  double weight = 0.0;       ///< of the bending against the sum of squares, units^2
  double bending = 0.0;      ///< integral of f_xx^2 + 2 f_xy^2 + f_yy^2 over the rectangle;
                             ///< 0 below the rounding of its sum
  EmptyParts empty;
};

/// Surface near points in any order, as a height f over a plane: the parameters run along the sides
/// of the smallest rectangle around the points in the plane, f is a bicubic C2 spline. For its
/// knots it has the smallest sum of squared distances along `up` plus `weight` times the bending.
/// Knots: spans are halved where a point is farther than the tolerance, until none is; of weights
/// in steps of 100 the largest that keeps the tolerance is taken. What is exactly a plane comes
/// back within rounding.
///
/// Guaranteed: each used point is at most the tolerance off along `up`, so at most that far from
/// the surface. Not guaranteed: the fewest knots; anything where there are no points (`empty`
/// tells). O(n log n) for the points and O(m k^2) for m control points, k of them across; memory
/// linear in the points, m k numbers for the control points.
///
/// Errors: E203 options; E303 not finite; E304 fewer than 3 points, or all on one line; E408 points
/// so near each other in the plane that a surface within the tolerance of both has to be steeper
/// than `steepest` (`index`, `last`: the points; `value`: degrees); E502 not within the tolerance
/// with 40,000 control points, or below rounding (`index`: the farthest point, `value`: how far);
/// E103.
[[nodiscard]] Result<ScatteredSurface> scattered(const std::vector<Vec3>& points,
                                                 const ScatterOptions& options,
                                                 const RunContext& run = {});

}  // namespace obvid
