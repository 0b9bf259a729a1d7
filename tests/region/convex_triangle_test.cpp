// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/convex_triangle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

TEST(ConvexTriangle, RightAngleOverAChordHasHalfItsHeight) {
  const auto t = tangent_triangle({0, 0}, {1, 1}, {2, 0}, {3, -3});
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->apex.x, 1.0, 1e-15);
  EXPECT_NEAR(t->apex.y, 1.0, 1e-15);
  EXPECT_NEAR(t->height, 1.0, 1e-15);
  EXPECT_NEAR(t->to_apex, std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(t->from_apex, std::sqrt(2.0), 1e-15);
  EXPECT_EQ(t->side, 1);
}

TEST(ConvexTriangle, MirrorImageHasTheOtherSide) {
  const auto t = tangent_triangle({0, 0}, {1, -2}, {3, 0}, {1, 1});
  ASSERT_TRUE(t);
  EXPECT_EQ(t->side, -1);
  EXPECT_NEAR(t->height, 2.0, 1e-15);
}

TEST(ConvexTriangle, NeighbouringChordsMeetInTheApex) {
  const auto t = chord_triangle({-1, -1}, {0, 0}, {2, 0}, {3, -1});
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->apex.x, 1.0, 1e-15);
  EXPECT_NEAR(t->apex.y, 1.0, 1e-15);
}

TEST(ConvexTriangle, ParallelLinesHaveNoApex) {
  EXPECT_FALSE(tangent_triangle({0, 0}, {0, 1}, {2, 0}, {0, 1}));
  EXPECT_FALSE(tangent_triangle({0, 0}, {0, 1}, {2, 0}, {0, -1}));
  EXPECT_FALSE(tangent_triangle({0, 0}, {1, 0}, {2, 0}, {1, 0}));
}

TEST(ConvexTriangle, ApexBehindTheStartOrAheadOfTheEndIsNone) {
  EXPECT_FALSE(tangent_triangle({0, 0}, {-1, 1}, {2, 0}, {-1, -2}));
  EXPECT_FALSE(tangent_triangle({0, 0}, {1, 1}, {2, 0}, {1, 1.5}));  // S-shape
  EXPECT_FALSE(chord_triangle({-1, -1}, {0, 0}, {2, 0}, {3, 1}));    // zigzag
}

TEST(ConvexTriangle, CoincidingPointsHaveNoTriangle) {
  EXPECT_FALSE(tangent_triangle({1, 1}, {1, 0}, {1, 1}, {0, 1}));
  EXPECT_FALSE(tangent_triangle({0, 0}, {0, 0}, {1, 1}, {0, 1}));
}

}  // namespace
}  // namespace obvid
