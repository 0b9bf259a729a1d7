// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/geom/vec2.h"

namespace obvid {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Smallest upright rectangle around what it was grown by; empty at first.
struct Box {
  Vec2 low{kInfinity, kInfinity};
  Vec2 high{-kInfinity, -kInfinity};

  void grow(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void grow(const Box& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y)};
  }
  [[nodiscard]] bool misses(const Box& b) const {
    return low.x > b.high.x || b.low.x > high.x || low.y > b.high.y || b.low.y > high.y;
  }
  /// Distance of a point from the rectangle, 0 inside; infinite from an empty one.
  [[nodiscard]] double distance(Vec2 p) const {
    return std::hypot(std::max({0.0, low.x - p.x, p.x - high.x}),
                      std::max({0.0, low.y - p.y, p.y - high.y}));
  }
};

}  // namespace obvid
