// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "found_chain.h"
#include "obvid/geom/vec2.h"

namespace obvid::alignment {

/// The circle that points lie on, once around in their order and each within its tolerance, as one
/// arc that begins and ends at the foot of the first point. Nothing where none was found.
[[nodiscard]] std::optional<FoundChain> whole_circle(const std::vector<Vec2>& points,
                                                     const std::vector<double>& tolerance);

}  // namespace obvid::alignment
