// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/surface/surface.h"

namespace obvid {

/// A region of the parameters where the offset folds back on itself: 1 - distance * k <= 0 for a
/// principal curvature k. (Signs as in `SurfaceCurvature`: the normal turns by -k times the way, so
/// a sphere seen from outside has k = -1/R and folds at distance -R, in its centre.)
struct FoldedRegion {
  Range u;  ///< the fold lies inside, at most one step of the raster away from the borders
  Range v;
  double worst_u = 0.0, worst_v = 0.0;  ///< where it is worst
  double curvature = 0.0;               ///< there, 1/unit
};

struct OffsetCheck {
  std::vector<FoldedRegion> folds;  ///< empty: no local self-intersection
  double largest_inwards = 0.0;     ///< largest distance against the normal without folds; infinity
                                    ///< where nothing curves that way
  double largest_outwards = 0.0;    ///< likewise along the normal
};

/// Where the offset of a surface folds locally, by principal curvatures on a raster over each span
/// that is refined until both greatest curvatures settle to 1e-3 of themselves; the greatest ones
/// are climbed to from the raster. At knots that are not C2 both sides count. Points without a
/// normal, such as poles, are left out; their neighbourhood counts. Curvatures below 1e-10
/// coordinates / size^2, which are rounding, count as flat. Global self-intersections (two distant
/// parts that meet) are not looked for, and regions are not joined across the seam of a closed
/// surface. The surface has to pass `check`. Where curvature has no bound (cusps, collapsed nets)
/// it does not settle; rasters end at a million points (the second one at four), or at 4 for each
/// span where those are more.
[[nodiscard]] OffsetCheck check_offset(const NurbsSurface& surface, double distance);

}  // namespace obvid
