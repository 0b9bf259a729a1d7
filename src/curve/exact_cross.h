// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/double_double.h"

namespace obvid::curve_detail {

/// A difference of points, exactly.
struct Leg {
  numeric::DoubleDouble x, y;
};

[[nodiscard]] inline Leg leg(Vec2 from, Vec2 to) {
  return {numeric::two_sum(to.x, -from.x), numeric::two_sum(to.y, -from.y)};
}

[[nodiscard]] inline Vec2 rounded(const Leg& l) { return {l.x.hi, l.y.hi}; }

[[nodiscard]] inline numeric::DoubleDouble cross(const Leg& a, const Leg& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace obvid::curve_detail
