// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "obvid/curve/pieces.h"

namespace obvid::test {

__extension__ typedef __float128 Quad;  // 113 bits

/// Curvature of a rational quartic in extended precision, by de Casteljau on the homogeneous curve.
inline long double extended_curvature(const RationalBezier& piece, long double parameter) {
  EXPECT_EQ(piece.degree, 4);
  // relative to the nearer end, which loses no digits: legs can be 1e-5 of a coordinate
  const Vec2 base = piece.offset[parameter < 0.5L ? 0 : 4];
  const Quad t = parameter;
  Quad value[3], d1[3], d2[3];  // x, y, w
  for (int c = 0; c < 3; ++c) {
    Quad p[5];
    for (std::size_t j = 0; j < 5; ++j) {
      const Quad w = piece.weight[j];
      const Quad x = Quad(piece.offset[j].x) - base.x;
      const Quad y = Quad(piece.offset[j].y) - base.y;
      p[j] = c == 0 ? w * x : (c == 1 ? w * y : w);
    }
    for (int level = 0; level < 2; ++level) {
      for (int j = 0; j < 4 - level; ++j) p[j] += t * (p[j + 1] - p[j]);
    }
    d2[c] = 12 * (p[0] - 2 * p[1] + p[2]);
    for (int j = 0; j < 2; ++j) p[j] += t * (p[j + 1] - p[j]);
    d1[c] = 4 * (p[1] - p[0]);
    value[c] = p[0] + t * (p[1] - p[0]);
  }
  const Quad w = value[2];
  const Quad ux = w * d1[0] - value[0] * d1[2], uy = w * d1[1] - value[1] * d1[2];
  const Quad det = value[0] * (d1[1] * d2[2] - d1[2] * d2[1]) -
                          value[1] * (d1[0] * d2[2] - d1[2] * d2[0]) +
                          w * (d1[0] * d2[1] - d1[1] * d2[0]);
  const auto speed = std::sqrt(static_cast<long double>(ux * ux + uy * uy));
  return static_cast<long double>(det * w * w * w) / (speed * speed * speed);
}

}  // namespace obvid::test
