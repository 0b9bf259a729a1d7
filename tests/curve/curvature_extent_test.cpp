// SPDX-License-Identifier: Apache-2.0
// Extremes of the curvature that lie between the parameters, against closed forms.
#include "obvid/curve/internal/curvature_extent.h"

#include <gtest/gtest.h>

#include <vector>

namespace obvid {
namespace {

std::vector<double> steps(int n) {
  std::vector<double> at;
  for (int i = 0; i <= n; ++i) at.push_back(static_cast<double>(i) / n);
  return at;
}

// y = c x^2 from x = -before to x = after: its curvature is 2 c at x = 0, and less elsewhere.
Piece dish(double c, double before, double after) {
  RationalBezier b;
  b.degree = 2;
  b.offset[0] = {-before, c * before * before};
  b.offset[1] = {0.5 * (after - before), -c * before * after};
  b.offset[2] = {after, c * after * after};
  b.weight[0] = b.weight[1] = b.weight[2] = 1.0;
  return b;
}

TEST(CurvatureExtent, FindsThePeakOfAParabolaBetweenParameters) {
  for (const double c : {0.5, 30.0, 1000.0}) {
    for (const double before : {0.3, 0.77, 1.9}) {
      const CurvatureExtent up = curvature_extent(dish(c, before, 1.0), steps(8));
      EXPECT_NEAR(up.largest, 2.0 * c, 1e-8 * c);
      const CurvatureExtent down = curvature_extent(dish(-c, before, 1.0), steps(8));
      EXPECT_NEAR(down.least, -2.0 * c, 1e-8 * c);
      EXPECT_LE(down.largest, 0.0);
      EXPECT_GE(up.least, 0.0);
    }
  }
}

}  // namespace
}  // namespace obvid
