// SPDX-License-Identifier: Apache-2.0
// Compiled the same way for all programs: they prove the same conics, bit for bit.
#include "hostile_conics.h"

#include <cmath>
#include <random>

std::vector<obvid::RationalBezier> hostile_conics(int count) {
  std::mt19937_64 random(20260105);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  std::vector<obvid::RationalBezier> conics;
  for (int k = 0; k < count; ++k) {
    const double a = uniform(0.5, 2.0), b = uniform(0.5, 2.0), phi = uniform(0.2, 1.4);
    const double turn = uniform(-3.0, 3.0), c = std::cos(turn), s = std::sin(turn);
    const obvid::Vec2 shift{uniform(-4.0, 4.0), uniform(-4.0, 4.0)};
    const auto placed = [&](double x, double y) {
      return obvid::Vec2{shift.x + (x * c - y * s), shift.y + (x * s + y * c)};
    };
    obvid::RationalBezier conic;
    conic.degree = 2;
    conic.offset[0] = placed(a, 0.0);
    conic.offset[1] = placed(a, b * std::tan(0.5 * phi));
    conic.offset[2] = placed(a * std::cos(phi), b * std::sin(phi));
    conic.weight = {1.0, std::cos(0.5 * phi), 1.0};
    conics.push_back(conic);
  }
  return conics;
}
