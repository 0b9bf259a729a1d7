// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fewest_pieces.h"
#include "obvid/geom/vec2.h"

namespace obvid::alignment {

/// Joints of the chords of points on a map with each corner rounded by an arc that passes its point
/// within the tolerance: many elements. There may be none (a chord that goes straight back, the
/// seam of a loop).
[[nodiscard]] std::vector<Node> rounded_corners(const std::vector<Vec2>& points,
                                                const std::vector<double>& tolerance);

}  // namespace obvid::alignment
