// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/geom/vec3.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

/// R2000 DXF of curves in space: a SPLINE each on the layer CONTOUR, exactly, and a POINT for each
/// point on the layer POINTS; unit in the header as `dxf_unit` says.
[[nodiscard]] std::string space_dxf(const std::vector<SpaceCurve>& curves,
                                    const std::vector<Vec3>& points, const Units& units);

}  // namespace obvid
