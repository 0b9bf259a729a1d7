// SPDX-License-Identifier: Apache-2.0
#include "obvid/geom/internal/chord.h"

#include <gtest/gtest.h>

#include <cmath>

#include "obvid/geom/internal/directions.h"
#include "obvid/geom/internal/polygon.h"

namespace obvid {
namespace {

TEST(Chord, IsNearestBesideItOrAtAnEnd) {
  const Vec2 a{1, 1}, b{5, 4};  // of length 5
  EXPECT_DOUBLE_EQ(part_of_chord(Vec2{3 - 3, 2.5 + 4}, a, b), 0.5);
  EXPECT_DOUBLE_EQ(distance_from_chord(Vec2{3 - 3, 2.5 + 4}, a, b), 5.0);
  EXPECT_EQ(part_of_chord(Vec2{-2, -3}, a, b), 0.0);
  EXPECT_DOUBLE_EQ(distance_from_chord(Vec2{-2, -3}, a, b), 5.0);
  EXPECT_EQ(part_of_chord(Vec2{8, 8}, a, b), 1.0);
  EXPECT_DOUBLE_EQ(distance_from_chord(Vec2{8, 8}, a, b), 5.0);
  EXPECT_DOUBLE_EQ(distance_from_chord(Vec3{0, 3, 9}, Vec3{0, 0, 5}, Vec3{0, 0, 20}), 3.0);
}

TEST(Chord, WithoutLengthIsAPoint) {
  const Vec3 a{1, 2, 3};
  EXPECT_EQ(part_of_chord(Vec3{4, 6, 3}, a, a), 0.0);
  EXPECT_DOUBLE_EQ(distance_from_chord(Vec3{4, 6, 3}, a, a), 5.0);
}

TEST(Polygon, HasAnAreaWithASignWhereverItLies) {
  std::vector<Vec2> l = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};  // an L: 4 + 2
  EXPECT_EQ(area_of_polygon(l), 6.0);
  for (Vec2& p : l) p = p + Vec2{1e9, -1e9};
  EXPECT_EQ(area_of_polygon(l), 6.0);
  EXPECT_EQ(area_of_polygon({l.rbegin(), l.rend()}), -6.0);
  EXPECT_EQ(area_of_polygon({}), 0.0);
  EXPECT_EQ(area_of_polygon({{1, 1}, {2, 2}}), 0.0);
}

TEST(Polygon, GoesAroundWhatIsInIt) {
  const std::vector<Vec2> l = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  EXPECT_TRUE(is_in_polygon(l, {0.5, 2.5}));
  EXPECT_TRUE(is_in_polygon(l, {3.5, 0.5}));
  EXPECT_FALSE(is_in_polygon(l, {2.0, 2.0}));
  EXPECT_FALSE(is_in_polygon(l, {-0.5, 1.0}));
  EXPECT_FALSE(is_in_polygon(l, {5.0, 0.5}));
  EXPECT_FALSE(is_in_polygon({}, {0.0, 0.0}));
}

TEST(Directions, HaveAnAngleThatKeepsItsDigits) {
  const double small = 1e-12;
  EXPECT_NEAR(angle_between({2, 0, 0}, {3, 3 * small, 0}), small, 1e-24);
  EXPECT_NEAR(angle_between({0, 1, 0}, {0, 0, 7}), std::acos(0.0), 1e-15);
  EXPECT_NEAR(angle_between({0, 0, 1}, {0, small, -1}), std::acos(-1.0) - small, 1e-15);
  EXPECT_NEAR(angle_between_lines({0, 0, 1}, {0, small, -1}), small, 1e-24);
}

}  // namespace
}  // namespace obvid
