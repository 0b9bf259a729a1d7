// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "obvid/surface/space_curve.h"

namespace obvid {

/// Knots that differ from one of `pattern` (ascending) by rounding become that one.
inline void snap(std::vector<double>& knots, const std::vector<double>& pattern) {
  for (double& u : knots) {
    const auto near = std::lower_bound(pattern.begin(), pattern.end(), u - kSameKnot);
    if (near != pattern.end() && std::abs(*near - u) <= kSameKnot) u = *near;
  }
}

}  // namespace obvid
