// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/coarse_polygon.h"
#include "../common/ten_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid {
namespace {

using PolygonPoints = std::vector<Vec2>;
constexpr double kDegree = std::numbers::pi / 180.0;

PolygonPoints regular_polygon(int corners) {
  PolygonPoints out;
  for (int k = 0; k < corners; ++k) out.push_back(unit_at(360.0 * kDegree * k / corners));
  return out;
}

TEST(CoarsePolygon, IsWhatTurnsByFortyDegreesAtATime) {
  const PolygonPoints ell{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
  const CoarsePolygon found = coarse_polygon(ell, {}, true, 20.0 * kDegree);
  EXPECT_EQ(found.corners.size(), 6U);
  EXPECT_NEAR(found.turn, 90.0 * kDegree, 1e-12);
  for (const int corners : {3, 4, 6, 8}) {
    EXPECT_EQ(coarse_polygon(regular_polygon(corners), {}, true, 20.0 * kDegree).corners.size(),
              static_cast<std::size_t>(corners));
  }
  for (const int corners : {10, 16, 100}) {
    EXPECT_FALSE(coarse_polygon(regular_polygon(corners), {}, true, 20.0 * kDegree).found());
  }
}

TEST(CoarsePolygon, PointsOnItsEdgesDoNotHideIt) {
  const PolygonPoints rectangle{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}};
  EXPECT_EQ(coarse_polygon(rectangle, {}, true, 20.0 * kDegree).corners,
            (std::vector<std::size_t>{0, 2, 3, 5}));
}

TEST(CoarsePolygon, ASpiralOfFewPointsIsNone) {
  // [000], Table 1: turns of some 50 degrees, curvatures that only fall
  EXPECT_FALSE(coarse_polygon(kTenPoints, {}, false, 0.3).found());
}

TEST(CoarsePolygon, StairsOfPixelsWithinTheirToleranceAreNone) {
  PolygonPoints stairs;
  for (int k = 0; k < 20; ++k) {
    stairs.push_back({0.5 * (k / 2) * 2.0, 0.5 * ((k + 1) / 2) * 2.0});
  }
  EXPECT_TRUE(coarse_polygon(stairs, {}, false, 20.0 * kDegree).found());
  EXPECT_FALSE(coarse_polygon(stairs, std::vector<double>(20, 0.5), false, 20.0 * kDegree).found());
}

}  // namespace
}  // namespace obvid
