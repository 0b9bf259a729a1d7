// SPDX-License-Identifier: Apache-2.0
// Splines of points alone: with directions at their ends against what ezdxf 0.18.1 makes of them
// (fit_points_to_cad_cv), without against the equations of the natural spline
// ([Boor 1978], chapter IV), solved elsewhere with 40 digits.
#include "obvid/pipeline/internal/through_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid {
namespace {

constexpr double kRoundingOfControls = 1e-12;

PointSeries five_points() {
  PointSeries out;
  out.points = {{0, 0}, {10, 5}, {20, 0}, {26, 8}, {30, 20}};
  out.spline = ThroughPoints{"SPLINE 2F on layer A", {}, {}};
  return out;
}

/// A control point of a piece.
Vec2 control(const DrawnCurve& curve, std::size_t piece, std::size_t k) {
  const auto& bezier = std::get<RationalBezier>(curve.pieces[piece]);
  return bezier.origin + bezier.offset[k];
}

void expect_control_at(Vec2 found, Vec2 expected) {
  EXPECT_NEAR(found.x, expected.x, kRoundingOfControls);
  EXPECT_NEAR(found.y, expected.y, kRoundingOfControls);
}

TEST(SplineThroughPoints, IsNaturalWithoutDirections) {
  const auto curve = spline_through(five_points());
  ASSERT_TRUE(curve);
  EXPECT_FALSE(curve->closed);
  EXPECT_EQ(curve->label, "SPLINE 2F on layer A");
  ASSERT_EQ(curve->pieces.size(), 4U);
  expect_control_at(control(*curve, 0, 1), {3.2687047626442623, 2.9009619437152625});
  expect_control_at(control(*curve, 3, 2), {28.927726284284759, 16.278145041147173});
  expect_control_at(end_point(curve->pieces[1]), {20, 0});
}

TEST(SplineThroughPoints, HasTheDirectionsThatAreGiven) {
  PointSeries series = five_points();
  series.spline->start = Vec2{0, 1};
  series.spline->end = Vec2{1, 0};
  const auto curve = spline_through(series);
  ASSERT_TRUE(curve);
  expect_control_at(control(*curve, 0, 1), {0.0, 3.72677996249965});
  expect_control_at(control(*curve, 3, 2), {25.78362978644216, 20.0});
}

TEST(SplineThroughPoints, IsNaturalAtTheOneEndWithoutADirection) {
  for (const bool at_start : {true, false}) {
    PointSeries series = five_points();
    (at_start ? series.spline->start : series.spline->end) = Vec2{0, 1};
    const auto curve = spline_through(series);
    ASSERT_TRUE(curve);
    const std::size_t given = at_start ? 0 : 3;
    const Jet there = evaluate(curve->pieces[given], at_start ? 0.0 : 1.0);
    EXPECT_NEAR(there.d1.x, 0.0, kRoundingOfControls * norm(there.d1));
    EXPECT_GT(there.d1.y, 0.0);
    const Jet other = evaluate(curve->pieces[3 - given], at_start ? 1.0 : 0.0);
    EXPECT_NEAR(norm(other.d2), 0.0, 1e-10);
  }
}

TEST(SplineThroughPoints, IsPeriodicWhereItIsClosedAndTakesPointsOnce) {
  PointSeries series;
  constexpr int kCount = 40;
  for (int k = 0; k < kCount; ++k) {
    series.points.push_back(10.0 * unit_at(2.0 * std::numbers::pi * k / kCount));
    if (k == 7) series.points.push_back(series.points.back());
  }
  series.points.push_back(series.points.front());
  series.spline = ThroughPoints{"", {}, {}};
  const auto curve = spline_through(series);
  ASSERT_TRUE(curve);
  EXPECT_TRUE(curve->closed);
  ASSERT_EQ(curve->pieces.size(), static_cast<std::size_t>(kCount));
  for (const Piece& piece : curve->pieces) {
    // of a circle, cubics with the right end speeds: h^4/384 of the angle, some 1.6e-5 of the
    // radius
    EXPECT_NEAR(norm(evaluate(piece, 0.5).point), 10.0, 1e-4);
  }
}

TEST(SplineThroughPoints, NeedsTwoPoints) {
  PointSeries series = five_points();
  series.points = {{1, 1}, {1, 1}};
  EXPECT_FALSE(spline_through(series));
}

}  // namespace
}  // namespace obvid
