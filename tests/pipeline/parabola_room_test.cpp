// SPDX-License-Identifier: Apache-2.0
// Parabolas of closed series whose largest curvature is to be the least possible.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <random>

#include "../common/long_runs.h"
#include "obvid/pipeline/construction_fit.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/why_not.h"

namespace obvid {
namespace {

/// Points at uneven places of an oval that differs at both ends.
PointSeries oval(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto in = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const int count = static_cast<int>(in(8.0, 24.0));
  const double flat = in(1.0, 2.8), egg = in(-0.15, 0.15);
  PointSeries out;
  for (int i = 0; i < count; ++i) {
    const double u = 2.0 * std::numbers::pi * (i + in(-0.25, 0.25)) / count;
    out.points.push_back(
        {50.0 * std::cos(u) * (1.0 + egg * std::cos(u)), 50.0 / flat * std::sin(u)});
  }
  out.points.push_back(out.points.front());
  return out;
}

/// At joints: between them the curvature is monotone, as was proved.
double most_curved(const Contour& contour) {
  double out = 0.0;
  for (const Joint& joint : contour.joints) out = std::max(out, std::abs(joint.element.kappa));
  return out;
}

/// Percent that a warning tells; the least largest curvature is kept within half of one without.
double told_percent(const std::vector<std::string>& warnings) {
  for (const std::string& one : warnings) {
    const std::size_t at = one.find(" within ", one.find("largest curvature:"));
    if (at != std::string::npos) return std::atof(one.c_str() + at + 8);
  }
  return 1.0;
}

TEST(ParabolaRoom, ParabolasOfTheLeastLargestCurvatureSayHowFarTheyAreFromIt) {
  const int kOvals = test::cases_of(5, 2);
  int told = 0, formed = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(kOvals); ++seed) {
    const PointSeries series = oval(seed);
    FitJob job;
    job.prefer = Prefer::kLeastCurvature;
    const auto spirals = fit(series, job);
    ASSERT_TRUE(spirals) << seed << ": " << to_line(spirals.error());
    const double least = most_curved(spirals->contour);  // no smaller than the least possible
    job.carrier = Carrier::kBeziers;
    const auto carrier = fit(series, job);
    RegionJob triangles;
    triangles.job.prefer = Prefer::kLeastCurvature;
    triangles.construction = Construction::kParabolas;
    const auto construction = fit_construction(series, triangles);
    for (const auto* made : {&carrier, &construction}) {
      if (!*made) {
        EXPECT_EQ(made->error().code, made == &carrier ? ErrorCode::kNoSpiral
                                                       : ErrorCode::kToleranceNotReached)
            << seed;
        continue;
      }
      ++formed;
      const Fit& one = **made;
      EXPECT_TRUE(one.certificate.proved) << seed << ": " << one.certificate.reason;
      const double percent = told_percent(one.warnings);
      if (percent > 1.0) ++told;
      if (made == &construction) continue;  // its radii are the triangles'
      EXPECT_LE(most_curved(one.contour), (1.0 + 0.01 * percent) * least) << seed;
    }
  }
  EXPECT_GE(formed, 2 * kOvals * 9 / 10);
  EXPECT_GE(told, 1);  // else there was nothing to try
  std::printf("%d of %d formed, %d with room\n", formed, 2 * kOvals, told);
}

/// Between two points the radius of this oval hardly changes while the contour turns on: parabolas
/// cannot follow. The refusal says so and, asked why, how far the points would have to move.
TEST(ParabolaRoom, WhatIsNearlyAnArcIsRefusedWithTheMoveThatHelps) {
  // 23 points of an ellipse with half axes 29.52 and 19.84, each off by up to 0.1
  PointSeries series;
  series.points = {
      {29.5134, 0.0162}, {28.4451, 5.4345}, {25.2151, 10.3186},
      {20.0864, 14.5431}, {13.5887, 17.6255}, {5.9852, 19.4971},
      {-2.0680, 19.7239}, {-9.8000, 18.6723}, {-17.1198, 16.2640},
      {-22.9660, 12.6122}, {-27.1662, 7.9602}, {-29.1789, 2.6554},
      {-29.2247, -2.6175}, {-27.0973, -7.8466}, {-22.9125, -12.4751},
      {-17.0074, -16.1158}, {-9.9583, -18.7212}, {-2.1072, -19.7946},
      {5.9573, -19.3905}, {13.6363, -17.5445}, {20.1322, -14.4330},
      {25.2361, -10.3017}, {28.4055, -5.4063}
  };
  FitJob job;
  job.closing = Closing::kClosed;
  job.carrier = Carrier::kBeziers;
  const auto refused = fit(series, job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kNoSpiral);
  EXPECT_NE(refused.error().what.find("nearly an arc"), std::string::npos) << refused.error().what;
  const auto why = why_not(series, job);
  ASSERT_TRUE(why);
  ASSERT_TRUE(why->found);
  EXPECT_LT(why->tolerance, 0.1);  // of the noise
  EXPECT_TRUE(why->fit.certificate.proved) << why->fit.certificate.reason;
}

}  // namespace
}  // namespace obvid
