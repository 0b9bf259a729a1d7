// SPDX-License-Identifier: Apache-2.0
// What is taken back of lines, arcs and corners that were chosen.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "fit/taken_back.h"

namespace obvid::pipeline_detail {
namespace {

LineOrArc row(std::size_t from, std::size_t to) {
  LineOrArc out;
  out.from = from;
  out.to = to;
  return out;
}

TEST(TakenBack, TheNearestLineGivesUpItsPointsAndThenTheNext) {
  const std::vector<LineOrArc> rows = {row(2, 5), row(9, 14)};
  TakenBack out;
  ASSERT_TRUE(take_back_nearest(rows, 7, 16, false, out));  // two points from both: the first
  EXPECT_EQ(out.loose, (std::vector<std::size_t>{2, 3, 4, 5}));
  ASSERT_TRUE(take_back_nearest(rows, 7, 16, false, out));
  EXPECT_EQ(out.loose.size(), 10U);
  EXPECT_FALSE(take_back_nearest(rows, 7, 16, false, out));
  ASSERT_EQ(out.told.size(), 2U);
  EXPECT_NE(out.told.front().find("a line (points 3-6) is not kept"), std::string::npos);
}

TEST(TakenBack, RoundAClosedSeriesTheNearerWayCounts) {
  const std::vector<LineOrArc> rows = {row(4, 8), row(14, 1)};  // of 16: 14, 15, 0, 1
  TakenBack out;
  ASSERT_TRUE(take_back_nearest(rows, 12, 16, true, out));  // two from the second, four from it
  std::sort(out.loose.begin(), out.loose.end());
  EXPECT_EQ(out.loose, (std::vector<std::size_t>{0, 1, 14, 15}));
}

TEST(TakenBack, CornersThatHardlyTurnAreNoneAndAreTakenBackOnce) {
  Contour contour;
  for (const double turn : {0.1, 1.0, -0.3}) {
    Joint joint;
    joint.element.theta = 6.2;  // past half a turn, as headings along a contour are
    joint.leaving = Element{{}, 6.2 + turn, 0.0};
    joint.after = contour.joints.size() * 10;
    contour.joints.push_back(joint);
  }
  contour.joints.push_back({});
  TakenBack out;
  EXPECT_TRUE(take_back_corners(contour, 0.35, out));
  EXPECT_EQ(out.unbroken, (std::vector<std::size_t>{0, 20}));
  EXPECT_FALSE(take_back_corners(contour, 0.35, out));
}

TEST(TakenBack, ThePointNearestToAJoint) {
  Contour contour;
  contour.points = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  Joint joint;
  joint.element.point = {1.4, 0.2};
  contour.joints.push_back(joint);
  EXPECT_EQ(point_nearest_to(0, contour), 1U);
}

}  // namespace
}  // namespace obvid::pipeline_detail
