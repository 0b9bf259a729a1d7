// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

/// The whole contour as one NURBS curve whose homogeneous form is C1: inner knots of multiplicity
/// degree - 1, weights within [0.1, 10], so that CAD kernels keep one edge (docs/methods/curve.md).
[[nodiscard]] Result<NurbsCurve> joined_nurbs(const Contour& contour);

}  // namespace obvid
