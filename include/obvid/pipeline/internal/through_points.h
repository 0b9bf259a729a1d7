// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// The spline that CAD systems draw through points of a SPLINE without control points (`spline` of
/// the series): docs/methods/dxf.md. Points that follow themselves count once. Errors: E304 fewer
/// than two different points, three of a closed one.
[[nodiscard]] Result<DrawnCurve> spline_through(const PointSeries& series);

}  // namespace obvid
