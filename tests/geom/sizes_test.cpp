// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

TEST(Angles, PrincipalDegreesAreThoseOfTheSameDirection) {
  EXPECT_DOUBLE_EQ(principal_degrees(0.5 * std::numbers::pi), 90.0);
  EXPECT_NEAR(principal_degrees(3.5 * std::numbers::pi), -90.0, 1e-12);
  EXPECT_NEAR(principal_degrees(-7.25 * std::numbers::pi), 135.0, 1e-12);
}

TEST(Angles, PositiveAnglesLieInOneTurn) {
  EXPECT_EQ(positive_angle(370.0, 360.0), 10.0);
  EXPECT_EQ(positive_angle(-90.0, 360.0), 270.0);
  EXPECT_EQ(positive_angle(-720.0, 360.0), 0.0);
  EXPECT_EQ(positive_angle(360.0, 360.0), 0.0);
}

TEST(Sizes, OfPointsAreTheDiagonalOfTheirBoxOrTheDistanceFromTheFirst) {
  const std::vector<Vec3> points = {{1, 0, 0}, {3, 3, 0}, {1, 0, 6}};
  EXPECT_EQ(bounding_diagonal(points), 7.0);  // 2, 3, 6
  EXPECT_EQ(farthest_from_first(points), 6.0);
  EXPECT_EQ(bounding_diagonal(std::vector<Vec3>{}), 0.0);
  EXPECT_EQ(farthest_from_first(std::vector<Vec3>{}), 0.0);
  struct Row {
    std::vector<Vec3> of;
  };
  const std::vector<Row> rows = {{{points[0], points[1]}}, {}, {{points[2]}}};
  EXPECT_EQ(bounding_diagonal(rows, &Row::of), 7.0);
}

}  // namespace
}  // namespace obvid
