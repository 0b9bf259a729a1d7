// SPDX-License-Identifier: Apache-2.0
// Where lines and circles touch each other, against places known beforehand; the length of a
// transition against the shift of a clothoid, integrated here.
#include "primitive_joints.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid::fairing_detail {
namespace {

/// A circle or line through a point with a heading.
Primitive through(Vec2 point, double theta, double kappa) {
  Primitive p;
  p.anchor = point;
  p.theta = theta;
  p.kappa = kappa;
  return p;
}

TEST(PrimitiveJoints, LineAndArcTouchWhereTheyWereDrawn) {
  // the x axis; a circle of radius 10 about (40, 10), anchored a quarter of a radian behind (40, 0)
  constexpr double kSize = 10.0, kBehind = 0.25;
  const Primitive line = through({3.0, 0.0}, 0.0, 0.0);
  const Primitive arc = through(
      {40.0 + kSize * std::sin(kBehind), kSize - kSize * std::cos(kBehind)}, kBehind, 1.0 / kSize);
  const auto there = tangent_place(line, arc), back = tangent_place(arc, line);
  ASSERT_TRUE(there && back);
  EXPECT_NEAR(there->on_first, 37.0, 1e-12);
  EXPECT_NEAR(there->on_second, -kBehind * kSize, 1e-12);
  EXPECT_NEAR(there->gap, 0.0, 1e-13);
  EXPECT_NEAR(back->on_first, -kBehind * kSize, 1e-12);
  EXPECT_NEAR(back->on_second, 37.0, 1e-12);
}

TEST(PrimitiveJoints, OppositeArcsTouchAndTheirGapIsTold) {
  // left turn about (0, 5), then right turn about (0, -2 - gap), both heading along x at x = 0
  constexpr double kGap = 1e-3;
  const Primitive left = through({5.0 * std::sin(-0.4), 5.0 - 5.0 * std::cos(-0.4)}, -0.4, 0.2);
  const Primitive right =
      through({2.0 * std::sin(0.3), -2.0 - kGap + 2.0 * std::cos(0.3)}, -0.3, -0.5);
  const auto place = tangent_place(left, right);
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->on_first, 2.0, 1e-12);
  EXPECT_NEAR(place->on_second, -0.6, 1e-12);
  EXPECT_NEAR(std::abs(place->gap), kGap, 1e-12);
}

TEST(PrimitiveJoints, LinesAndCirclesOfOneSizeHaveNoPlace) {
  EXPECT_FALSE(tangent_place(through({0.0, 0.0}, 0.0, 0.0), through({1.0, 0.0}, 0.5, 0.0)));
  EXPECT_FALSE(tangent_place(through({0.0, 0.0}, 0.0, 0.1), through({1.0, 0.0}, 0.5, 0.1)));
}

TEST(PrimitiveJoints, FeetOnCirclesAreArcLengths) {
  const Primitive arc = through({0.0, 0.0}, 0.0, -0.25);  // about (0, -4)
  for (const double turn : {-3.0, -1.0, 0.0, 0.5, 2.9}) {
    const double far = 4.3;  // a point a little off the circle
    const Vec2 p{far * std::sin(turn), -4.0 + far * std::cos(turn)};
    EXPECT_NEAR(foot_on(arc, p), 4.0 * turn, 1e-12);
  }
}

TEST(PrimitiveJoints, AClothoidOfThatLengthKeepsItsCirclesApart) {
  constexpr double kKappa = 0.1, kShift = 1e-3;
  const double length = transition_length(0.0, kKappa, kShift);
  // from the x axis on; the circle at its end stays that far above the axis
  constexpr int kSteps = 20000;
  double y = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = (i + 0.5) * length / kSteps;
    const double theta = 0.5 * kKappa / length * s * s;
    y += std::sin(theta) * length / kSteps;
  }
  const double theta = 0.5 * kKappa * length;
  const double lowest = y + std::cos(theta) / kKappa - 1.0 / kKappa;
  EXPECT_NEAR(lowest / kShift, 1.0, 0.01);  // to first order in the turn
}

}  // namespace
}  // namespace obvid::fairing_detail
