// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/core/units.h"

namespace obvid {

/// The angle that means the same direction, rad, in [-pi, pi].
[[nodiscard]] inline double principal_angle(double theta) {
  return std::remainder(theta, kFullTurn);
}

/// The same in degrees, in [-180, 180].
[[nodiscard]] inline double principal_degrees(double theta) {
  return principal_angle(theta) / kOneDegree;
}

/// The angle that means the same direction, in [0, turn), where a whole turn is `turn`.
[[nodiscard]] inline double positive_angle(double angle, double turn) {
  const double rest = std::fmod(angle, turn);
  return rest < 0.0 ? rest + turn : rest;
}

/// The turn from one direction to another one, rad, in [-pi, pi]: to the left positive.
[[nodiscard]] inline double turn_between(double from, double to) {
  return principal_angle(to - from);
}

/// The angle that means the same direction as `theta` and lies nearest to another one, rad: at most
/// half a turn from it.
[[nodiscard]] inline double nearest_angle(double theta, double to) {
  return to + turn_between(to, theta);
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
