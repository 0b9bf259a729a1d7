// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid::curve_detail {

/// Point of the projective plane: weighted coordinates and weight.
struct Homogeneous {
  double x = 0.0, y = 0.0, w = 0.0;

  friend Homogeneous operator+(Homogeneous a, Homogeneous b) {
    return {a.x + b.x, a.y + b.y, a.w + b.w};
  }
  friend Homogeneous operator-(Homogeneous a, Homogeneous b) {
    return {a.x - b.x, a.y - b.y, a.w - b.w};
  }
  friend Homogeneous operator*(double s, Homogeneous a) { return {s * a.x, s * a.y, s * a.w}; }
};

}  // namespace obvid::curve_detail
