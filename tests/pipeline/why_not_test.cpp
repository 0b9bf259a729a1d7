// SPDX-License-Identifier: Apache-2.0
// What a refused job lacks: the tolerance that is named must do, what is a little smaller must not,
// and where geometry tells the smallest possible tolerance it must not be undercut.
#include "obvid/pipeline/why_not.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "obvid/io/read_points.h"

namespace obvid {
namespace {

PointSeries series_through(std::vector<Vec2> points) {
  PointSeries series;
  series.points = std::move(points);
  return series;
}

/// Points of a parabola, but for one that lies `dent` too high: no convex curve meets it and both
/// its neighbours.
PointSeries dented_parabola(double dent) {
  std::vector<Vec2> points;
  for (int i = -6; i <= 6; ++i) {
    const double x = 0.5 * i;
    points.push_back({x, 0.5 * x * x + (i == 1 ? dent : 0.0)});
  }
  return series_through(std::move(points));
}

FitJob convex_job() {
  FitJob job;
  job.convex = true;
  return job;
}

Result<Fit> again(const PointSeries& series, FitJob job, double tolerance) {
  job.noise = tolerance;
  job.noise_from_rounding = false;
  return fit(series, job);
}

/// What holds for every answer.
void expect_sound(const WhyNot& why, const PointSeries& series, const FitJob& job) {
  EXPECT_TRUE(why.fit.certificate.proved);
  EXPECT_LE(why.fit.report.largest_move, why.advised);
  EXPECT_GE(why.advised, why.tolerance);
  if (!why.next_to_nothing) {
    EXPECT_EQ(why.advised, why.tolerance);
  }
  EXPECT_LT(why.refused, why.tolerance);
  // 2 % and a third digit, unless the least tolerance of which anybody speaks will do
  if (why.refused > 0.0) {
    EXPECT_LE(why.tolerance, 1.03 * why.refused);
  }
  for (const double noise : {why.tolerance, why.advised}) {
    const auto made = again(series, job, noise);
    ASSERT_TRUE(made) << made.error().what;
    EXPECT_TRUE(made->certificate.proved);
  }
  const auto below = again(series, job, why.refused);
  EXPECT_FALSE(below && below->certificate.proved);
  ASSERT_FALSE(why.moved.empty());
  const std::vector<double>& moves = why.fit.report.moves;
  ASSERT_EQ(moves.size(), why.fit.contour.points.size());
  for (std::size_t k = 1; k < why.moved.size(); ++k) {
    EXPECT_GE(moves[why.moved[k - 1]], moves[why.moved[k]]);
  }
  EXPECT_EQ(moves[why.moved.front()], why.fit.report.largest_move);
}

TEST(WhyNot, HasNothingToSayAboutAPossibleJob) {
  EXPECT_FALSE(why_not(dented_parabola(0.0), convex_job()));
}

TEST(WhyNot, HasNothingToSayAboutMalformedInput) {
  PointSeries series = dented_parabola(0.0);
  series.points[2].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(why_not(series, {}));
}

TEST(WhyNot, NamesTheToleranceWithinWhichADentedSeriesIsConvex) {
  const double dent = 0.3;
  const PointSeries series = dented_parabola(dent);
  const auto why = why_not(series, convex_job());
  ASSERT_TRUE(why);
  EXPECT_EQ(why->refusal.code, ErrorCode::kFixedDataContradict);
  expect_sound(*why, series, convex_job());
  EXPECT_EQ(why->fit.certificate.inflections, 0);
  // Three neighbours (0, 0), (1/2, 1/8 + dent), (1, 1/2) on a curve turning left: the middle one is
  // above the chord by dent - 1/8. On a left turn it is below the chord, which moves of t can bring
  // about only if 2 t is more than that height across the chord.
  const double above = (dent - 0.125) / std::hypot(1.0, 0.5);
  EXPECT_GE(why->tolerance, 0.5 * above);
  EXPECT_LE(why->tolerance, dent);  // the point moved back onto its parabola is one solution
}

TEST(WhyNot, FindsNoSmallerToleranceThanTheSizeOfALargerDentAsks) {
  const auto small = why_not(dented_parabola(0.3), convex_job());
  const auto large = why_not(dented_parabola(0.4), convex_job());
  ASSERT_TRUE(small && large);
  EXPECT_GT(large->tolerance, small->tolerance);
}

TEST(WhyNot, KeepsAFixedHeadingThatExactPointsRefuse) {
  // points of a spiral about the origin, and a heading at the fifth that is off its tangent
  std::vector<Vec2> points;
  for (int i = 0; i < 9; ++i) {
    const double angle = 0.3 * i, radius = 1.0 + 0.002 * i * i;
    points.push_back({radius * std::sin(angle), radius * std::cos(angle)});
  }
  const PointSeries series = series_through(std::move(points));
  FitJob job;
  PointConstraint wish;
  wish.index = 4;
  wish.theta = -0.3 * 4 - 0.35;  // the tangent there is near -1.2
  job.constraints.push_back(wish);
  const auto why = why_not(series, job);
  ASSERT_TRUE(why);
  expect_sound(*why, series, job);
  bool met = false;
  for (const Joint& joint : why->fit.contour.joints) {
    if (joint.source != std::size_t{4}) continue;
    met = true;
    EXPECT_NEAR(std::remainder(joint.element.theta - *wish.theta, 2.0 * std::acos(-1.0)), 0.0,
                1e-9);
  }
  EXPECT_TRUE(met);
}

TEST(WhyNot, ScalesWithTheSeries) {
  const auto one = why_not(dented_parabola(0.3), convex_job());
  PointSeries larger = dented_parabola(0.3);
  for (Vec2& p : larger.points) p = 1024.0 * p;
  const auto other = why_not(larger, convex_job());
  ASSERT_TRUE(one && other);
  EXPECT_NEAR(other->tolerance / (1024.0 * one->tolerance), 1.0, 0.03);
}

TEST(WhyNot, RaisesTheTolerancesThatPointsHaveOfTheirOwn) {
  PointSeries series = dented_parabola(0.3);
  series.fixed.resize(series.points.size());
  for (FixedData& data : series.fixed) data.tolerance = 1e-4;
  const auto why = why_not(series, convex_job());
  ASSERT_TRUE(why);
  for (const double t : why->fit.contour.point_tolerance) EXPECT_EQ(t, why->tolerance);
}

TEST(WhyNot, WhatIsNextToNothingIsAdvisedBesideTheWidthOfTheRegion) {
  // a spiral with a heading against it: it takes vertices between points, not room at them
  const auto series = read_points(std::string(OBVID_TEST_DATA) + "/found/coil_85.csv");
  ASSERT_TRUE(series);
  FitJob job;
  PointConstraint wish;
  wish.index = 1;
  wish.theta = 0.0;  // the tangent there is near 109 degrees
  job.constraints.push_back(wish);
  const auto why = why_not(*series, job);
  ASSERT_TRUE(why);
  ASSERT_TRUE(why->next_to_nothing);
  EXPECT_FALSE(why->rounding_does);  // the file has all digits of its doubles
  constexpr double kLeast = 2e-3;    // a hundredth of the width, and a digit's rounding
  EXPECT_GT(why->advised, kLeast * why->fit.report.tolerance);
}

TEST(WhyNot, TellsProgress) {
  double last = -1.0;
  int calls = 0;
  const auto why = why_not(dented_parabola(0.3), convex_job(), [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    EXPECT_LE(done, 1.0);
    last = done;
    ++calls;
  });
  ASSERT_TRUE(why);
  EXPECT_GT(calls, 3);
}

}  // namespace
}  // namespace obvid
