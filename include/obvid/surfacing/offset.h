// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/surface/surface.h"

namespace obvid {

/// A region of the parameters where the offset folds back on itself: 1 + distance * k <= 0 for a
/// principal curvature k (signs as in `SurfaceCurvature`).
struct FoldedRegion {
  Range u;
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

/// Where the offset of a surface folds locally, by principal curvatures on a raster that is refined
/// until both greatest curvatures settle to 1e-3 of themselves. Global self-intersections (two
/// distant parts that meet) are not looked for.
[[nodiscard]] OffsetCheck check_offset(const NurbsSurface& surface, double distance);

}  // namespace obvid
