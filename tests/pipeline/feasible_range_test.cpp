// SPDX-License-Identifier: Apache-2.0
// What a given heading or curvature that stands in the way could be instead: both ends of the range
// must do, a little beyond must not, and what a known curve of the wished kind has lies between.
#include "obvid/pipeline/feasible_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace obvid {
namespace {

using Datum = FeasibleRange::Datum;

/// Points of a branch of a parabola, along which the curvature falls.
PointSeries half_parabola() {
  PointSeries series;
  for (int i = 1; i <= 6; ++i) series.points.push_back({0.5 * i, 0.125 * i * i});
  return series;
}

FitJob wishing(std::size_t point, Datum datum, double value) {
  FitJob job;
  PointConstraint wish;
  wish.index = point;
  (datum == Datum::kHeading ? wish.theta : wish.kappa) = value;
  job.constraints.push_back(wish);
  return job;
}

bool does(std::size_t point, Datum datum, double value) {
  const auto made = fit(half_parabola(), wishing(point, datum, value));
  return made && made->certificate.proved;
}

void expect_range(std::size_t point, Datum datum, double asked, double of_the_parabola) {
  const FitJob job = wishing(point, datum, asked);
  const auto refused = fit(half_parabola(), job);
  ASSERT_FALSE(refused);
  const auto range = feasible_range(half_parabola(), job, refused.error());
  ASSERT_TRUE(range);
  EXPECT_EQ(range->point, point);
  EXPECT_EQ(range->datum, datum);
  EXPECT_EQ(range->asked, asked);
  EXPECT_LT(range->least, of_the_parabola);
  EXPECT_GT(range->greatest, of_the_parabola);
  EXPECT_TRUE(does(point, datum, range->least));
  EXPECT_TRUE(does(point, datum, range->greatest));
  const double beyond = 0.05 * (range->greatest - range->least);
  EXPECT_FALSE(does(point, datum, range->least - beyond));
  EXPECT_FALSE(does(point, datum, range->greatest + beyond));
}

TEST(FeasibleRange, OfAHeadingHoldsThatOfTheCurveBehindThePoints) {
  expect_range(2, Datum::kHeading, 0.2, std::atan(1.5));
}

TEST(FeasibleRange, OfACurvatureHoldsThatOfTheCurveBehindThePoints) {
  expect_range(2, Datum::kCurvature, 3.0, std::pow(1.0 + 1.5 * 1.5, -1.5));
}

TEST(FeasibleRange, HeadingsAreGivenInTheFirstTurn) {
  const FitJob job = wishing(2, Datum::kHeading, -5.0 * std::numbers::pi);
  const auto refused = fit(half_parabola(), job);
  ASSERT_FALSE(refused);
  const auto range = feasible_range(half_parabola(), job, refused.error());
  ASSERT_TRUE(range);
  EXPECT_GT(range->least, 0.0);
  EXPECT_LT(range->greatest, 0.5 * std::numbers::pi);
}

/// An ellipse of 50 nm at an offset of 20,000 times its size: with continuous slopes not all can be
/// kept that can be kept without.
TEST(FeasibleRange, IsThatOfTheContinuityThatWasAskedFor) {
  PointSeries series;
  for (const Vec2 p :
       {Vec2{18380.395211745472, 9723.4389462065756}, Vec2{18380.39521146924, 9723.4389404850863},
        Vec2{18380.395210448674, 9723.4389338480796}, Vec2{18380.395208314942, 9723.4389262367713},
        Vec2{18380.395204570461, 9723.4389176611603}, Vec2{18380.395198568542, 9723.4389082616744},
        Vec2{18380.395189514365, 9723.438898405042}}) {
    series.points.push_back(p);
  }
  FitJob job;
  job.noise = 2.112e-10;
  job.continuity = Continuity::kG3;
  FitJob asked = job;
  asked.start_kappa = -1.0 / 5.2966101694915253e-05;
  asked.start_kappas = ValueRange{1.0 / 9.2706720995227131e-06, 1.0 / 7.4755012534441943e-06};
  const auto refused = fit(series, asked);
  ASSERT_FALSE(refused);
  const auto range = feasible_range(series, asked, refused.error());
  ASSERT_TRUE(range);
  for (const double value : {range->least, range->greatest}) {
    job.start_kappa = value;
    EXPECT_TRUE(fit(series, job)) << value;
  }
}

TEST(FeasibleRange, IsNothingWhereNothingIsFixed) {
  FitJob job;
  job.convex = true;
  PointSeries series;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{1, 1}, Vec2{2, 0}, Vec2{3, -1}, Vec2{4, 0}}) {
    series.points.push_back(p);
  }
  const auto refused = fit(series, job);
  ASSERT_FALSE(refused);
  EXPECT_FALSE(feasible_range(series, job, refused.error()));
}

TEST(FeasibleRange, IsNothingWhereTwoDataAreInTheWay) {
  FitJob job = wishing(1, Datum::kHeading, 4.0);
  job.constraints.push_back({4, 4.0, std::nullopt, false});
  const auto refused = fit(half_parabola(), job);
  ASSERT_FALSE(refused);
  EXPECT_FALSE(feasible_range(half_parabola(), job, refused.error()));
}

}  // namespace
}  // namespace obvid
