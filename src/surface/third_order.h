// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "obvid/surface/nurbs_surface.h"

namespace obvid {

/// Partial derivatives: entry [r][q] is r times by u, q times by v, r + q <= 3; the rest is 0.
using Partials = std::array<std::array<Vec3, 4>, 4>;

[[nodiscard]] Partials partials_to_third(const NurbsSurface& surface, double u, double v);

/// Partial derivatives to second order of du x dv.
[[nodiscard]] Partials partials_of_area(const Partials& surface);

/// Partial derivatives to second order of a vector field scaled to length 1; it must not vanish.
[[nodiscard]] Partials partials_of_unit(const Partials& vector);

}  // namespace obvid
