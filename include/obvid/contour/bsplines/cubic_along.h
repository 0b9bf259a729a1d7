// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/internal/bspline_cubic.h"

namespace obvid {

/// A cubic spline in place of a contour.
struct CubicAlong {
  CubicSpline spline;      ///< C2; `as_nurbs` makes it a B-spline
  double deviation = 0.0;  ///< upper bound of the distance of either from the other: see
                           ///< path_distance
};

/// C2 cubic spline within `tolerance` (units) of a contour, for systems that read nothing else: it
/// interpolates points of the contour that lie closer where the contour's fourth derivative is
/// large, with its tangents at both ends. As few points as were found; input points are passed
/// within the tolerance. Curvature is continuous but no longer monotone by construction: near a
/// spiral it mostly is, which `certify` can tell span by span.
/// Errors: E203 a tolerance that is not greater than 0; E311 no pieces; E310 a corner (`index`: the
/// joint); E502 not reached with 65,536 spans (`value`: the deviation), or places fall together in
/// doubles (`value`: their rounding); E103 ended by `watch`.
/// Cost: some ten splines of the final size.
[[nodiscard]] Result<CubicAlong> cubic_along(const Contour& contour, double tolerance,
                                             Watch* watch = nullptr);

}  // namespace obvid
