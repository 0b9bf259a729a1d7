// SPDX-License-Identifier: Apache-2.0
// A closed series that means one circle: it begins at a point of the series, and nothing is open.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

TEST(WholeCircle, BeginsAtThePointThatItsFirstJointNames) {
  constexpr double kRadius = 50.0, kMostMove = 0.05;
  int circles = 0;
  for (const int count : {12, 24, 37, 48, 72, 100}) {
    for (const double turned : {0.0, 0.7, 2.9}) {
      PointSeries series;
      for (int i = 0; i < count; ++i) {
        const double a = turned + 2.0 * std::numbers::pi * i / count;
        const double r = kRadius + 0.3 * kMostMove * std::sin(5.0 * i);
        series.points.push_back({r * std::cos(a), r * std::sin(a)});
      }
      FitJob job;
      job.closing = Closing::kClosed;
      job.primitives = true;
      job.noise = kMostMove;
      const auto made = fit(series, job);
      ASSERT_TRUE(made) << to_line(made.error());
      for (const Joint& joint : made->contour.joints) {
        if (!joint.source) continue;
        EXPECT_LE(norm(joint.element.point - series.points[*joint.source]), kMostMove)
            << count << " points, point " << *joint.source + 1;
      }
      if (!std::holds_alternative<ArcPiece>(made->contour.pieces.front())) continue;
      ++circles;
      EXPECT_TRUE(made->warnings.empty()) << made->warnings.front();
      EXPECT_EQ(made->certificate.vertices, 0);
    }
  }
  EXPECT_GE(circles, 5);
}

}  // namespace
}  // namespace obvid
