// SPDX-License-Identifier: Apache-2.0
// Headings and radii that a designer fixes, at the ends and inside, come out in the contour.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
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

}  // namespace
}  // namespace obvid
