// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/geom/vec2.h"

namespace obvid::toolpath {

/// Where the two arcs meet that leave `from` along the unit vector `leaving` and arrive at `to`
/// along `arriving`, by equal lengths of tangents; nothing: they would turn by half a turn or more.
[[nodiscard]] std::optional<Vec2> biarc_joint(Vec2 from, Vec2 leaving, Vec2 to, Vec2 arriving);

/// Half way along the arc that leaves `from` along `leaving` (length 1) and ends in `to`.
[[nodiscard]] Vec2 arc_middle(Vec2 from, Vec2 leaving, Vec2 to);

}  // namespace obvid::toolpath
