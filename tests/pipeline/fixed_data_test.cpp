// SPDX-License-Identifier: Apache-2.0
// Headings and radii that a designer fixes, at the ends and inside, come out in the contour.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

/// Headings of pieces are proved equal to the elements' to this.
constexpr double kSameHeading = 1e-9;
constexpr double kSameCurvature = 1e-9;  // relative

/// Circle involute from t = 1 on: heading t, curvature 1/t.
PointSeries involute() {
  PointSeries series;
  for (int i = 0; i < 9; ++i) {
    const double t = 1.0 + 0.35 * i;
    series.points.push_back({std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)});
  }
  return series;
}
double involute_parameter(std::size_t i) { return 1.0 + 0.35 * static_cast<double>(i); }

Fit proved(const PointSeries& series, const FitJob& job) {
  auto f = fit(series, job);
  if (!f) {
    ADD_FAILURE() << to_line(f.error());
    return {};
  }
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
  EXPECT_EQ(f->certificate.vertices, 0);
  return std::move(*f);
}

double heading_gap(double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); }

void expect_at_start(const Fit& f, double theta, double kappa) {
  const Jet jet = evaluate(f.contour.pieces.front(), 0.0);
  EXPECT_NEAR(heading_gap(heading(jet.d1), theta), 0.0, kSameHeading);
  EXPECT_NEAR(curvature(jet), kappa, kSameCurvature * std::abs(kappa));
}

TEST(FixedData, EndHeadingsAndRadiiOfTheTrueCurveAreMet) {
  FitJob job;
  const PointSeries series = involute();
  const std::size_t last = series.points.size() - 1;
  job.start_heading = involute_parameter(0);
  job.start_kappa = 1.0 / involute_parameter(0);
  job.end_heading = involute_parameter(last);
  job.end_kappa = 1.0 / involute_parameter(last);
  for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs}) {
    job.carrier = carrier;
    const Fit f = proved(series, job);
    if (f.contour.pieces.empty()) continue;
    const Jet start = evaluate(f.contour.pieces.front(), 0.0);
    const Jet end = evaluate(f.contour.pieces.back(), 1.0);
    EXPECT_NEAR(heading_gap(heading(start.d1), *job.start_heading), 0.0, kSameHeading);
    EXPECT_NEAR(heading_gap(heading(end.d1), *job.end_heading), 0.0, kSameHeading);
    if (carrier != Carrier::kSpiral) continue;  // arcs promise tangents only
    expect_at_start(f, *job.start_heading, *job.start_kappa);
    EXPECT_NEAR(curvature(end), *job.end_kappa, kSameCurvature);
    EXPECT_EQ(f.contour.joints.front().element.kappa, *job.start_kappa);
    EXPECT_EQ(f.contour.joints.back().element.kappa, *job.end_kappa);
  }
}

TEST(FixedData, HeadingsAndRadiiInsideAreMet) {
  PointSeries series = involute();
  series.fixed.resize(series.points.size());
  series.fixed[3].theta = involute_parameter(3) + 0.002;
  series.fixed[5].kappa = 1.01 / involute_parameter(5);
  const Fit f = proved(series, FitJob{});
  for (const Joint& joint : f.contour.joints) {
    if (!joint.source) continue;
    const FixedData& data = series.fixed[*joint.source];
    const Element& e = joint.element;
    EXPECT_NEAR(heading_gap(e.theta, data.theta.value_or(e.theta)), 0.0, 1e-12);
    EXPECT_EQ(e.kappa, data.kappa.value_or(e.kappa));  // to the last bit
  }
}

TEST(FixedData, AZeroCurvatureAtTheEndIsMet) {
  // y = x^3 inside its monotone part, begun at its inflection
  PointSeries series;
  for (int i = 0; i < 7; ++i) series.points.push_back({0.05 * i, std::pow(0.05 * i, 3.0)});
  FitJob job;
  job.start_heading = 0.0;
  job.start_kappa = 0.0;
  const Fit f = proved(series, job);
  ASSERT_FALSE(f.contour.pieces.empty());
  const Jet start = evaluate(f.contour.pieces.front(), 0.0);
  EXPECT_NEAR(heading(start.d1), 0.0, kSameHeading);
  EXPECT_NEAR(curvature(start), 0.0, kSameCurvature);
}

TEST(FixedData, ContradictionsAreRefusedByTheirOwnCode) {
  const PointSeries series = involute();
  const auto refused = [&](const FitJob& job) {
    const auto f = fit(series, job);
    ASSERT_FALSE(f);
    EXPECT_EQ(f.error().code, ErrorCode::kFixedDataContradict) << to_line(f.error());
  };
  FitJob backwards;
  backwards.start_heading = involute_parameter(0) + std::numbers::pi;
  refused(backwards);
  FitJob growing;  // the points demand a falling curvature
  growing.start_kappa = 0.1;
  growing.end_kappa = 1.0;
  refused(growing);
}

TEST(FixedData, OnOneCircleThereIsNothingToChoose) {
  PointSeries circle;
  for (int i = 0; i < 6; ++i) circle.points.push_back({std::cos(0.4 * i), std::sin(0.4 * i)});
  FitJob job;
  job.start_heading = 1.0;
  const auto f = fit(circle, job);
  ASSERT_FALSE(f);
  EXPECT_EQ(f.error().code, ErrorCode::kFixedDataContradict);
}

TEST(FixedData, MergedPointsKeepTheDataOfTheFirst) {
  PointSeries series = involute();
  series.points.insert(series.points.begin() + 4, series.points[4]);
  series.fixed.resize(series.points.size());
  series.fixed[4].kappa = 1.0 / involute_parameter(4);
  const Fit f = proved(series, FitJob{});
  bool met = false;
  for (const Joint& joint : f.contour.joints)
    met = met || (joint.source == 4U && joint.element.kappa == *series.fixed[4].kappa);
  EXPECT_TRUE(met);
  EXPECT_EQ(f.warnings.size(), 1U);
}

/// What one of several sources fixes at the first and the last of some points.
using Source = void (*)(PointSeries&, FitJob&, double value);

/// Both of a pair say it once with the same value, and once with two.
void expect_one_value(const PointSeries& points, Source one, Source other, double value) {
  for (const double factor : {1.0, 1.25}) {
    PointSeries series = points;
    series.fixed.resize(series.points.size());
    FitJob job;
    one(series, job, value);
    other(series, job, factor * value);
    const auto made = fit(series, job);
    if (factor == 1.0) {
      EXPECT_TRUE(made) << to_line(made.error());
      continue;
    }
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kBadOption) << to_line(made.error());
    EXPECT_NE(made.error().what.find("fixed at one point"), std::string::npos);
  }
}

TEST(FixedData, TwoValuesOfOneDatumAreRefusedWhereverTheyComeFrom) {
  const PointSeries points = involute();
  constexpr std::size_t kLast = 8;
  const double first = involute_parameter(0), last = involute_parameter(kLast);
  using S = PointSeries;
  using J = FitJob;
  const Source file_theta = [](S& s, J&, double v) { s.fixed[0].theta = v; };
  const Source point_theta = [](S&, J& j, double v) { j.constraints.push_back({0, v, {}, false}); };
  const Source start_theta = [](S&, J& j, double v) { j.start_heading = v; };
  expect_one_value(points, file_theta, point_theta, first);
  expect_one_value(points, file_theta, start_theta, first);
  expect_one_value(points, point_theta, start_theta, first);
  const Source file_kappa = [](S& s, J&, double v) { s.fixed[kLast].kappa = v; };
  const Source point_kappa = [](S&, J& j, double v) {
    j.constraints.push_back({kLast, {}, v, false});
  };
  const Source end_kappa = [](S&, J& j, double v) { j.end_kappa = v; };
  expect_one_value(points, file_kappa, point_kappa, 1.0 / last);
  expect_one_value(points, file_kappa, end_kappa, 1.0 / last);
  expect_one_value(points, point_kappa, end_kappa, 1.0 / last);
}

TEST(FixedData, AWholeTurnMoreIsTheSameHeading) {
  FitJob job;
  job.start_heading = involute_parameter(0);
  job.constraints.push_back({0, involute_parameter(0) - 2.0 * std::numbers::pi, {}, false});
  EXPECT_TRUE(fit(involute(), job));
}

TEST(FixedData, AClosedSeriesHasOneHeadingWhereItBegins) {
  PointSeries series;
  for (int i = 0; i <= 12; ++i) {
    const Vec2 p = unit_at(i * std::numbers::pi / 6.0);
    series.points.push_back({2.0 * p.x, p.y});
  }
  series.points.back() = series.points.front();
  FitJob job;
  job.start_heading = 0.5 * std::numbers::pi;
  job.end_heading = 0.6 * std::numbers::pi;
  const auto made = fit(series, job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kBadOption);
  job.end_heading = job.start_heading;
  EXPECT_TRUE(fit(series, job));
}

TEST(FixedData, AConvexContourOfTwoPointsTurnsAsItsRadiusSays) {
  PointSeries two;
  two.points = {{42.0, 0.0}, {41.0, -6.0}};
  const double along = std::atan2(-6.0, -1.0);
  for (const Continuity continuity : {Continuity::kG2, Continuity::kG3}) {
    for (const double kappa : {0.18, -0.18}) {
      FitJob job;
      job.convex = true;
      job.continuity = continuity;
      job.end_kappa = kappa;
      job.start_heading = along - 2.0 * kappa;
      job.end_heading = along + 3.0 * kappa;
      const Fit f = proved(two, job);
      EXPECT_EQ(f.certificate.inflections, 0);
    }
  }
}

TEST(FixedData, AConvexContourRefusesARadiusThatTurnsTheOtherWay) {
  FitJob job;
  job.convex = true;
  job.start_kappa = -1.0 / involute_parameter(0);
  const auto made = fit(involute(), job);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kFixedDataContradict);
  EXPECT_EQ(made.error().where, "point 1");
}

}  // namespace
}  // namespace obvid
