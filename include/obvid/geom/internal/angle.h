// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/core/units.h"

namespace obvid {

/// The angle that means the same direction as `theta` and lies nearest to another one, rad: at most
/// half a turn from it.
[[nodiscard]] inline double nearest_angle(double theta, double to) {
  return to + std::remainder(theta - to, kFullTurn);
}

/// Least and largest of some angles against one direction, rad.
struct AngleRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double angle) {
    low = std::min(low, angle);
    high = std::max(high, angle);
  }
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double width() const { return empty() ? 0.0 : high - low; }
};

}  // namespace obvid
