// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "obvid/exchange/internal/points/airfoil.h"

namespace obvid {
namespace {

/// An ellipse with a blunt end at x = 1 whose lower side hooks up steeply to its last point, as
/// flatbacks in tables do.
std::vector<Vec2> flatback(double last_low) {
  constexpr int kCount = 60;
  constexpr double kHalf = 3.14159265358979323846;
  std::vector<Vec2> out;
  for (int i = 0; i <= kCount; ++i) {
    const double t = 0.18 * kHalf + (2.0 - 0.36) * kHalf * i / kCount;
    out.push_back({0.55 + 0.55 * std::cos(t), 0.24 * std::sin(t)});
  }
  for (Vec2& p : out) p = {(p.x) / out.front().x, p.y};
  out.back() = {1.0 - 2e-4, out.back().y};
  out.push_back({1.0, last_low});
  return out;
}

TEST(AirfoilPoints, TrailingEdgesThatLieApartAreAsThickAsTheyLieApart) {
  const std::vector<Vec2> points = flatback(-0.12);
  AirfoilFigures chord;
  chord.chord = 1.0;
  const auto figures = airfoil_point_figures(points, chord);
  ASSERT_TRUE(figures);
  EXPECT_NEAR(figures->trailing_thickness, points.front().y + 0.12, 1e-12);
}

}  // namespace
}  // namespace obvid
