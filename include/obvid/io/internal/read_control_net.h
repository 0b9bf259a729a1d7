// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "obvid/core/result.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// Control points as a surface: named columns patch, row, col, x, y, z make Bezier patches; lines
/// of points "x,y,z;x,y,z;..." (.cpt) a net of degree 3 (less with few points) with uniform clamped
/// knots; "wx,wy,wz,w;..." (.cptw) likewise with weights, and quadratic arcs with double knots
/// where a direction has an odd number of points and weights 1 in every other one. Errors: E301 to
/// E307 with place; what `check` finds.
[[nodiscard]] Result<SurfaceModel> read_control_net(const std::string& path);
[[nodiscard]] Result<SurfaceModel> parse_control_net(std::string_view text, std::string_view name);

}  // namespace obvid
