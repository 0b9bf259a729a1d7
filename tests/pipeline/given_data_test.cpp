// SPDX-License-Identifier: Apache-2.0
// What a user fixes is kept by every carrier, or the job is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "../common/ten_points.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kSame = 1e-6;  // rad, and of a curvature: what the report calls met

PointSeries ten_points() {
  PointSeries series;
  series.points = kTenPoints;
  return series;
}

/// Largest miss of headings and curvatures, on either side of each point.
void expect_kept(const Contour& contour, const std::vector<GivenDatum>& given) {
  for (const GivenDatum& one : given) {
    bool found = false;
    for (std::size_t j = 0; j < contour.joints.size(); ++j) {
      if (contour.joints[j].source != one.point) continue;
      found = true;
      std::vector<Jet> sides;
      if (j > 0) sides.push_back(evaluate(contour.pieces[j - 1], 1.0));
      if (j < contour.pieces.size()) sides.push_back(evaluate(contour.pieces[j], 0.0));
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const Jet& side : sides) {
        if (one.theta) {
          EXPECT_NEAR(std::remainder(heading(side.d1) - *one.theta, 2.0 * std::numbers::pi), 0.0,
                      kSame);
        }
        low = std::min(low, curvature(side));
        high = std::max(high, curvature(side));
      }
      if (!one.kappa) continue;
      const double room = kSame * std::abs(*one.kappa);
      if (contour.carrier == Carrier::kArcs) {
        EXPECT_LE(low, *one.kappa + room);
        EXPECT_GE(high, *one.kappa - room);
      } else {
        EXPECT_NEAR(low, *one.kappa, room);
        EXPECT_NEAR(high, *one.kappa, room);
      }
    }
    EXPECT_TRUE(found) << "no joint stands on point " << one.point;
  }
}

struct Wish {
  const char* name;
  FitJob job;
};

std::vector<Wish> constraints() {
  std::vector<Wish> out;
  FitJob inner;
  inner.constraints.push_back({4, 80.0 * kDegree, {}, false});
  out.push_back({"a heading inside", inner});
  FitJob end_radius;
  end_radius.end_kappa = -1.0 / 500.0;
  out.push_back({"a radius at the end", end_radius});
  FitJob start_radius;
  start_radius.start_kappa = -1.0 / 4.0;
  out.push_back({"a radius at the start", start_radius});
  FitJob end_heading;
  end_heading.end_heading = -39.0 * kDegree;
  out.push_back({"a heading at the end", end_heading});
  FitJob radius_inside;
  radius_inside.constraints.push_back({4, {}, -1.0 / 33.0, false});
  out.push_back({"a radius inside", radius_inside});
  FitJob both = inner;
  both.end_kappa = -1.0 / 500.0;
  both.start_heading = -62.0 * kDegree;
  out.push_back({"two headings and a radius", both});
  return out;
}

TEST(GivenData, EveryCarrierKeepsThemOrRefuses) {
  std::size_t kept = 0, refused = 0;
  for (const Wish& wish : constraints()) {
    for (const Carrier carrier : kAllCarriers) {
      FitJob job = wish.job;
      job.carrier = carrier;
      const auto f = fit(ten_points(), job);
      if (!f) {
        ++refused;
        EXPECT_TRUE(carrier == Carrier::kCubic || carrier == Carrier::kBaseline)
            << to_string(carrier) << " with " << wish.name << ": " << to_line(f.error());
        EXPECT_EQ(f.error().code, ErrorCode::kCarrierCannotKeep);
        EXPECT_GE(f.error().index, 0);
        continue;
      }
      ++kept;
      SCOPED_TRACE(std::string(to_string(carrier)) + " with " + wish.name);
      ASSERT_FALSE(f->contour.given.empty());
      expect_kept(f->contour, f->contour.given);
      EXPECT_LE(f->report.given.heading_miss, kSame);
      EXPECT_LE(f->report.given.curvature_miss, kSame);
    }
  }
  EXPECT_GE(kept, 36U);
  EXPECT_GT(refused, 0U);
}

TEST(GivenData, TheReportCountsThem) {
  FitJob job;
  job.constraints.push_back({4, 80.0 * kDegree, {}, false});
  job.constraints.push_back({7, {}, {}, true});
  job.end_kappa = -1.0 / 500.0;
  const auto f = fit(ten_points(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_EQ(f->report.given.headings, 1U);
  EXPECT_EQ(f->report.given.curvatures, 1U);
  EXPECT_EQ(f->report.given.corners, 1U);
}

TEST(GivenData, AFileWhoseContourMissesThemIsFalse) {
  FitJob job;
  job.constraints.push_back({4, 80.0 * kDegree, {}, false});
  auto f = fit(ten_points(), job);
  ASSERT_TRUE(f);
  const auto verdict = [&] { return verify({f->contour, f->report, f->certificate}); };
  EXPECT_FALSE(verdict().false_claim);
  f->contour.given.front().theta = 81.0 * kDegree;
  EXPECT_TRUE(verdict().false_claim);
  f->contour.given.front().theta = 80.0 * kDegree;
  f->report.given.headings = 2;
  EXPECT_TRUE(verdict().false_claim);
}

TEST(GivenData, StandInTheFile) {
  FitJob job;
  job.constraints.push_back({4, 80.0 * kDegree, -1.0 / 33.0, false});
  const auto f = fit(ten_points(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  const auto stored =
      contour_from_json(contour_to_json({f->contour, f->report, f->certificate}), "x");
  ASSERT_TRUE(stored) << to_line(stored.error());
  ASSERT_EQ(stored->contour.given.size(), 1U);
  EXPECT_EQ(stored->contour.given.front().point, 4U);
  EXPECT_EQ(stored->contour.given.front().theta, 80.0 * kDegree);
  EXPECT_EQ(stored->contour.given.front().kappa, -1.0 / 33.0);
  EXPECT_FALSE(verify(*stored).false_claim);
}

TEST(GivenData, ASlopeAtOneEndOfTheBaselineLeavesTheOtherAlone) {
  FitJob job;
  job.carrier = Carrier::kBaseline;
  job.start_heading = -60.0 * kDegree;
  const auto f = fit(ten_points(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_NEAR(heading(evaluate(f->contour.pieces.front(), 0.0).d1), -60.0 * kDegree, 1e-12);
  FitJob plain;
  plain.carrier = Carrier::kBaseline;
  const auto free = fit(ten_points(), plain);
  ASSERT_TRUE(free);
  EXPECT_NEAR(heading(evaluate(f->contour.pieces.back(), 1.0).d1),
              heading(evaluate(free->contour.pieces.back(), 1.0).d1), 1e-9);
}

TEST(GivenData, TwoPointsNeedBothHeadings) {
  PointSeries series;
  series.points = {{20.0, -1.0}, {38.0, 90.0}};
  FitJob job;
  job.end_kappa = 0.33;
  for (int headings = 0; headings < 3; ++headings) {
    if (headings > 0) job.start_heading = 60.0 * kDegree;
    if (headings > 1) job.end_heading = 110.0 * kDegree;
    const auto f = fit(series, job);
    ASSERT_EQ(f.has_value(), headings == 2);
    if (!f) {
      EXPECT_EQ(f.error().code, ErrorCode::kTooFewPoints);
    }
  }
}

}  // namespace
}  // namespace obvid
