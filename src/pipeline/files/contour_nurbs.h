// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/nurbs.h"

namespace obvid::pipeline_detail {

/// A contour as one NURBS curve.
struct ContourNurbs {
  NurbsCurve curve;
  double deviation = 0.0;  ///< units; 0: exact apart from rounding
};

/// Exact, joined as `joined_nurbs` says; contours with clothoids are followed by a C2 cubic within
/// the tolerance. Errors: of `joined_nurbs` and `cubic_along`.
[[nodiscard]] Result<ContourNurbs> contour_nurbs(const Contour& contour, double tolerance);

}  // namespace obvid::pipeline_detail
