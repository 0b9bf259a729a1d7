// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/nurbs_surface.h"

namespace obvid {

struct LightSurfaces {
  std::vector<NurbsSurface> surfaces;
  /// Bound of the distance of any point of a light surface from the given one at the same
  /// parameters, units: of the control points of the difference, by the convex hull.
  double moved = 0.0;
};

enum class LightWhere { kBoth, kAlong };

/// The same surfaces with few control points: weighted least squares along u and then along v,
/// knots where they are needed, none that could go by itself; `moved` <= tolerance. Degrees stay;
/// inner knots become single, so along u the surface is C4 where it was C2. Points, first and
/// second derivatives by u at both ends of u stay, and the first and the last row: seams and
/// borders that were smooth are smooth still. Where nothing lighter is found a direction stays as
/// it is.
///
/// Not guaranteed: curvature, which a tolerance of positions does not bound; the fewest knots.
///
/// With `LightWhere::kAlong` knots along v stay as they are.
///
/// `given`: polynomial, with one degree and one row of knots along v in common, as neighbours
/// have. Errors: E203 tolerance not > 0 and finite, rational surfaces or other knots.
[[nodiscard]] Result<LightSurfaces> lightened(const std::vector<NurbsSurface>& given,
                                              double tolerance, const RunContext& run = {},
                                              LightWhere where = LightWhere::kBoth);

}  // namespace obvid
