// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/surface/nurbs_surface.h"

namespace obvid {

/// Bound of the distance of any points of two polynomial surfaces with the same parameters, which
/// have degrees and knots across in common: of the control points of their difference, by the
/// convex hull. Those of few knots and of many are compared as they are.
[[nodiscard]] double distance_bound(const NurbsSurface& a, const NurbsSurface& b);

}  // namespace obvid
