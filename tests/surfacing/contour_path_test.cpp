// SPDX-License-Identifier: Apache-2.0
#include "contour_path.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

/// A line, then a rational quarter circle of radius 2 whose parameter runs unevenly, to the left.
Contour line_and_arc() {
  Contour contour;
  contour.pieces.push_back(LinePiece{{-3, 0}, {0, 0}});
  // weights 1, w sqrt(1/2), w^2: the same circle at another speed
  const double w = 1.7;
  contour.pieces.push_back(
      RationalBezier{{}, 2, {Vec2{0, 0}, {2, 0}, {2, 2}}, {1.0, w * std::sqrt(0.5), w * w}});
  return contour;
}

TEST(ContourPath, ReachesEachPlaceByItsArcLength) {
  const ContourPath path(line_and_arc());
  EXPECT_NEAR(path.length(), 3 + kPi, 1e-13);
  EXPECT_EQ(path.joint(1), 3.0);
  for (int k = 0; k <= 400; ++k) {
    const double angle = kPi / 2 * k / 400.0;
    const ContourPath::Place place = path.at(3 + 2 * angle);
    EXPECT_NEAR(place.point.x, 2 * std::sin(angle), 1e-12) << k;
    EXPECT_NEAR(place.point.y, 2 - 2 * std::cos(angle), 1e-12) << k;
    EXPECT_NEAR(turning(unit_at(angle), place.tangent), 0.0, 1e-12) << k;
    EXPECT_NEAR(place.kappa, 0.5, 1e-12) << k;
  }
}

TEST(ContourPath, TakesTheAskedSideOfAJoint) {
  const ContourPath path(line_and_arc());
  EXPECT_EQ(path.at(3.0, true).kappa, 0.0);
  EXPECT_NEAR(path.at(3.0, false).kappa, 0.5, 1e-14);
}

TEST(ContourPath, FindsTheNearestPlace) {
  const ContourPath path(line_and_arc());
  for (const double angle : {0.1, 0.7, 1.5}) {
    for (const double away :
         {-0.5, 0.0, 1.0}) {  // along the normal, towards the centre at most half
      const Vec2 p{(2 - away) * std::sin(angle), 2 - (2 - away) * std::cos(angle)};
      EXPECT_NEAR(path.nearest(p, 3.5, 0.0, path.length()), 3 + 2 * angle, 1e-12);
    }
  }
  EXPECT_NEAR(path.nearest({-1, 5}, 0.5, 0.0, 3.0), 2.0, 1e-12);
  EXPECT_EQ(path.nearest({-9, 1}, 0.5, 0.0, 3.0), 0.0);
}

}  // namespace
}  // namespace obvid
