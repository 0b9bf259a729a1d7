// SPDX-License-Identifier: Apache-2.0
#include "obvid/geom/internal/circle.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

TEST(CircleOfSquares, IsTheOneThatPointsLieOnAndNoneOfPointsOnALine) {
  const Vec2 centre{3.0, -2.0};
  std::vector<Vec2> points;
  for (int k = 0; k < 7; ++k) points.push_back(centre + 5.0 * unit_at(0.3 * k));
  const auto circle = circle_of_squares(points);
  ASSERT_TRUE(circle);
  EXPECT_NEAR(circle->centre.x, centre.x, 1e-13);
  EXPECT_NEAR(circle->centre.y, centre.y, 1e-13);
  EXPECT_NEAR(circle->radius, 5.0, 1e-13);
  EXPECT_FALSE(circle_of_squares({{0.0, 0.0}, {1.0, 0.0}, {3.0, 0.0}, {4.0, 0.0}}));
}

}  // namespace
}  // namespace obvid
