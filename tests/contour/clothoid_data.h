// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <random>

#include "obvid/curve/pieces.h"

namespace obvid::test {

inline double uniform_between(std::mt19937_64& rng, double low, double high) {
  return low + (high - low) * (static_cast<double>(rng() >> 11) * 0x1p-53);
}

/// End of a unit clothoid from (0, 0) by composite quadrature (8-point Gauss-Legendre): written
/// apart from the engine's formulas.
inline Vec2 end_by_quadrature(double theta, double kappa0, double kappa1, double length) {
  constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290,
                                           0.7966664774136267, 0.9602898564975363};
  constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873,
                                             0.2223810344533745, 0.1012285362903763};
  const double turn = std::max(std::abs(kappa0), std::abs(kappa1)) * std::abs(length);
  const int panels = 1 + static_cast<int>(turn);
  const double half = 0.5 * length / panels, rate = (kappa1 - kappa0) / length;
  Vec2 z;
  for (int j = 0; j < panels; ++j) {
    for (std::size_t g = 0; g < kNode.size(); ++g) {
      for (const double side : {-1.0, 1.0}) {
        const double s = (2 * j + 1 + side * kNode[g]) * half;
        z = z + half * kWeight[g] * unit_at(theta + s * (kappa0 + 0.5 * rate * s));
      }
    }
  }
  return z;
}

inline double end_heading(const ClothoidPiece& p) {
  return p.theta0 + 0.5 * (p.kappa0 + p.kappa1) * p.length;
}

/// How far the piece's own numbers lead from its stored end.
inline double end_miss(const ClothoidPiece& p) {
  return norm(p.start + end_by_quadrature(p.theta0, p.kappa0, p.kappa1, p.length) - p.end);
}

}  // namespace obvid::test
