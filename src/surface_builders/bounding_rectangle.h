// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// A rectangle that stands in any direction.
struct TurnedRectangle {
  Vec2 corner;           ///< from which both sides run
  Vec2 along{1.0, 0.0};  ///< of the longer side, length 1; the shorter one runs to its left
  double width = 0.0;    ///< of the longer side
  double depth = 0.0;    ///< of the shorter one
};

/// The smallest rectangle around points: one of its sides lies on a side of their convex hull
/// (Freeman and Shapira 1975). Its direction has the larger of its coordinates positive. O(n log
/// n).
[[nodiscard]] TurnedRectangle smallest_rectangle(std::vector<Vec2> points);

}  // namespace obvid
