// SPDX-License-Identifier: Apache-2.0
// Ranges of headings and curvatures are kept by every carrier, or the job is refused; what is
// chosen inside them is what was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "../common/ten_points.h"
#include "fit/given.h"
#include "fit/series_ranges.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {
namespace {

constexpr double kKeptTo = 1e-6;  // rad, and of a curvature: what the report calls kept

PointSeries reference_series() {
  PointSeries series;
  series.points = kTenPoints;
  return series;
}

PointConstraint heading_range(std::size_t point, double low_deg, double high_deg) {
  PointConstraint wish;
  wish.index = point;
  wish.thetas = ValueRange{low_deg * kOneDegree, high_deg * kOneDegree};
  return wish;
}

PointConstraint kappa_range(std::size_t point, double low, double high) {
  PointConstraint wish;
  wish.index = point;
  wish.kappas = ValueRange{low, high};
  return wish;
}

/// Headings and curvatures on both sides of a point.
std::vector<Jet> sides_of(const Contour& contour, std::size_t point) {
  std::vector<Jet> out;
  for (std::size_t j = 0; j < contour.joints.size(); ++j) {
    if (contour.joints[j].source != point) continue;
    if (j > 0) out.push_back(evaluate(contour.pieces[j - 1], 1.0));
    if (j < contour.pieces.size()) out.push_back(evaluate(contour.pieces[j], 0.0));
  }
  if (!out.empty()) return out;
  double least = HUGE_VAL;  // a carrier that passes the point has it on a piece
  for (const Piece& piece : contour.pieces) {
    const Jet jet = evaluate(piece, nearest_parameter(piece, contour.points[point]));
    const double away = norm(jet.point - contour.points[point]);
    if (away >= least) continue;
    least = away;
    out = {jet};
  }
  return out;
}

void expect_inside(const Contour& contour, const PointConstraint& wish) {
  const std::vector<Jet> sides = sides_of(contour, wish.index);
  ASSERT_FALSE(sides.empty());
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const Jet& side : sides) {
    if (wish.thetas) {
      const double theta = nearest_angle(heading(side.d1), wish.thetas->low);
      EXPECT_GE(theta, wish.thetas->low - kKeptTo);
      EXPECT_LE(theta, wish.thetas->high + kKeptTo);
    }
    low = std::min(low, curvature(side));
    high = std::max(high, curvature(side));
  }
  if (!wish.kappas) return;
  const double room = kKeptTo * std::abs(wish.kappas->low);
  if (contour.carrier == Carrier::kArcs) {  // between both arcs
    EXPECT_LE(low, wish.kappas->high + room);
    EXPECT_GE(high, wish.kappas->low - room);
    return;
  }
  EXPECT_GE(low, wish.kappas->low - room);
  EXPECT_LE(high, wish.kappas->high + room);
}

/// None of them holds what the fairest contour has: heading 80.4 degrees, radius -33.9.
std::vector<PointConstraint> narrow_ranges() {
  return {heading_range(4, 76.0, 78.0),
          heading_range(4, 82.0, 84.0),
          kappa_range(4, -1.0 / 31.0, -1.0 / 32.0 + 1e-4),
          kappa_range(9, -1.0 / 400.0, -1.0 / 500.0),
          kappa_range(0, -1.0 / 4.0, -1.0 / 4.5),
          heading_range(9, -43.0, -41.0)};
}

TEST(GivenRanges, EveryCarrierKeepsThemOrRefuses) {
  std::size_t kept = 0, refused = 0;
  for (const PointConstraint& wish : narrow_ranges()) {
    for (const Carrier carrier : kAllCarriers) {
      FitJob job;
      job.carrier = carrier;
      job.constraints.push_back(wish);
      const auto f = fit(reference_series(), job);
      SCOPED_TRACE(std::string(to_string(carrier)) + " at point " + std::to_string(wish.index + 1));
      if (!f) {
        ++refused;
        EXPECT_TRUE(carrier == Carrier::kCubic || carrier == Carrier::kBaseline)
            << to_line(f.error());
        EXPECT_EQ(f.error().code, ErrorCode::kCarrierCannotKeep) << to_line(f.error());
        continue;
      }
      ++kept;
      expect_inside(f->contour, wish);
      EXPECT_EQ(f->report.given.heading_ranges + f->report.given.curvature_ranges, 1U);
      EXPECT_LE(f->report.given.heading_miss, kKeptTo);
      EXPECT_LE(f->report.given.curvature_miss, kKeptTo);
    }
  }
  EXPECT_GE(kept, 36U);
  EXPECT_GT(refused, 0U);
}

TEST(GivenRanges, OfTwoThatAreAFullTurnApartTheCommonPartHolds) {
  FitJob job;
  for (const double turns : {-720.0, 0.0, 360.0}) {
    job.constraints = {heading_range(4, 70.0 + turns, 78.0 + turns), heading_range(4, 76.0, 90.0)};
    const auto f = fit(reference_series(), job);
    ASSERT_TRUE(f) << to_line(f.error());
    expect_inside(f->contour, heading_range(4, 76.0, 78.0));
  }
  job.constraints = {heading_range(4, 350.0, 430.0), heading_range(4, 80.0, 100.0)};
  EXPECT_EQ(fit(reference_series(), job).error().code, ErrorCode::kFixedDataContradict);
  job.constraints = {heading_range(4, 0.0, 300.0), heading_range(4, 250.0, 380.0)};
  EXPECT_EQ(fit(reference_series(), job).error().code, ErrorCode::kFixedDataContradict)
      << "0..20 and 250..300 are left";
  job.constraints = {heading_range(4, 0.0, 400.0), heading_range(4, 76.0, 78.0)};
  const auto free = fit(reference_series(), job);
  ASSERT_TRUE(free) << to_line(free.error());
  expect_inside(free->contour, heading_range(4, 76.0, 78.0));
}

TEST(GivenRanges, TheEndAtWhichTheContourLiesIsNamed) {
  FitJob job;
  job.constraints.push_back(heading_range(4, 76.0, 78.0));
  job.end_kappas = ValueRange{-1.0 / 400.0, -1.0 / 500.0};
  const auto f = fit(reference_series(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  const std::vector<ActiveRange> expected{{4, true, true}, {9, false, true}};
  EXPECT_EQ(f->report.given.active, expected);
}

TEST(GivenRanges, ACornerMayLieAtBothEndsOfItsRange) {
  // a lens of two quarter circles: it comes to the corner at the origin with 225 degrees and leaves
  // it with 315
  const double radius = std::numbers::sqrt2, quarter = 0.5 * std::numbers::pi;
  Contour lens;
  lens.closed = true;
  lens.points = {{0.0, 0.0}, {2.0, 0.0}};
  lens.pieces = {
      ArcPiece{{0.0, 0.0}, {2.0, 0.0}, -45.0 * kOneDegree, 1.0 / radius, radius * quarter},
      ArcPiece{{2.0, 0.0}, {0.0, 0.0}, 135.0 * kOneDegree, 1.0 / radius, radius * quarter}};
  const auto corner = [&](std::size_t point, double arriving_deg, double leaving_deg) {
    const Vec2 p = lens.points[point];
    return Joint{{p, arriving_deg * kOneDegree, 1.0 / radius},
                 point,
                 Element{p, leaving_deg * kOneDegree, 1.0 / radius}};
  };
  lens.joints = {corner(0, 225.0, 315.0), corner(1, 45.0, 135.0)};
  GivenDatum given;
  given.thetas = ValueRange{225.0 * kOneDegree, 315.0 * kOneDegree};
  lens.given = {given};
  const std::vector<ActiveRange> both{{0, true, false}, {0, true, true}};
  EXPECT_EQ(pipeline_detail::measure_given(lens).active, both);
  lens.given[0].thetas = ValueRange{225.0 * kOneDegree, 320.0 * kOneDegree};
  EXPECT_EQ(pipeline_detail::measure_given(lens).active,
            (std::vector<ActiveRange>{{0, true, false}}));
}

TEST(GivenRanges, AJointThatIsTheNearestPlaceHasTwoSides) {
  // the second point is beside a joint of no point, which turns by a thousandth
  const double turn = 1e-3;
  Contour bent;
  bent.points = {{-1.0, 0.0}, {0.0, -1e-6}, {std::cos(turn), std::sin(turn)}};
  const Vec2 joint{0.0, 0.0};
  bent.pieces = {LinePiece{bent.points[0], joint}, LinePiece{joint, bent.points[2]}};
  bent.joints = {Joint{{bent.points[0], 0.0, 0.0}, 0}, Joint{{joint, 0.0, 0.0}, std::nullopt},
                 Joint{{bent.points[2], turn, 0.0}, 2}};
  GivenDatum given;
  given.point = 1;
  for (const double theta : {0.0, turn}) {
    given.theta = theta;
    bent.given = {given};
    EXPECT_NEAR(pipeline_detail::measure_given(bent).heading_miss, turn, 1e-11);
  }
  given.theta = 0.25 * turn;
  bent.given = {given};
  EXPECT_NEAR(pipeline_detail::measure_given(bent).heading_miss, 0.75 * turn, 1e-11);
}

TEST(GivenRanges, OnlyTheEndItselfSaysHowNearIsAtTheEnd) {
  // radius 1,000 in the range of curvatures 0.000999 to 100: a thousandth of its least end away
  Contour arc;
  arc.points = {{0.0, 0.0}, {1.0, 0.0}};
  const double kappa = 1e-3, half = std::asin(0.5 * kappa);
  arc.pieces = {ArcPiece{{0.0, 0.0}, {1.0, 0.0}, -half, kappa, 2.0 * half / kappa}};
  arc.joints = {Joint{{{0.0, 0.0}, -half, kappa}, 0}, Joint{{{1.0, 0.0}, half, kappa}, 1}};
  GivenDatum given;
  given.kappas = ValueRange{0.000999, 100.0};
  arc.given = {given};
  EXPECT_TRUE(pipeline_detail::measure_given(arc).active.empty());
  arc.given[0].kappas = ValueRange{kappa * (1.0 - 1e-7), 100.0};
  EXPECT_EQ(pipeline_detail::measure_given(arc).active,
            (std::vector<ActiveRange>{{0, false, false}}));
}

TEST(GivenRanges, ThoseThatHoldTheFairestContourChangeNothing) {
  FitJob job;
  job.constraints.push_back(heading_range(4, 79.0, 82.0));
  const auto f = fit(reference_series(), job), free = fit(reference_series(), {});
  ASSERT_TRUE(f && free);
  EXPECT_TRUE(f->report.given.active.empty());
  for (std::size_t j = 0; j < free->contour.joints.size(); ++j) {
    EXPECT_NEAR(f->contour.joints[j].element.theta, free->contour.joints[j].element.theta, 1e-9);
  }
}

TEST(GivenRanges, AFalseRangeOrEndInAFileIsFound) {
  FitJob job;
  job.constraints.push_back(heading_range(4, 76.0, 78.0));
  const auto f = fit(reference_series(), job);
  ASSERT_TRUE(f);
  StoredContour stored{f->contour, f->report, f->certificate};
  EXPECT_FALSE(verify(stored).false_claim);
  StoredContour narrower = stored;
  narrower.contour.given[0].thetas->high -= 0.01;
  EXPECT_TRUE(verify(narrower).false_claim);
  StoredContour silent = stored;
  silent.report->given.active.clear();
  EXPECT_TRUE(verify(silent).false_claim);
  StoredContour other = stored;
  other.report->given.active[0].high = false;
  EXPECT_TRUE(verify(other).false_claim);
}

TEST(GivenRanges, AFileKeepsThem) {
  FitJob job;
  job.constraints.push_back(heading_range(4, 76.0, 78.0));
  job.end_kappas = ValueRange{-HUGE_VAL, -1.0 / 500.0};
  const auto f = fit(reference_series(), job);
  ASSERT_TRUE(f);
  const std::string text = contour_to_json({f->contour, f->report, f->certificate});
  const auto read = contour_from_json(text, "f");
  ASSERT_TRUE(read) << to_line(read.error());
  ASSERT_EQ(read->contour.given.size(), 2U);
  EXPECT_EQ(read->contour.given[0].thetas->high, 78.0 * kOneDegree);
  EXPECT_EQ(read->contour.given[1].kappas->low, -HUGE_VAL);
  EXPECT_EQ(read->report->given.active, f->report.given.active);
}

TEST(GivenRanges, OneOutsideWhatThePointsAllowIsRefusedAndOneAcrossItsEndIsNot) {
  const auto analysis = analyse(kTenPoints);
  ASSERT_TRUE(analysis);
  const auto ranges = pipeline_detail::series_ranges(*analysis, {});
  ASSERT_TRUE(ranges);
  for (std::size_t i = 1; i + 1 < kTenPoints.size(); ++i) {
    const HeadingRange& here = *(*ranges)[i].heading;
    const double step = 0.01 * (here.high - here.low);
    FitJob outside, across;
    PointConstraint wish;
    wish.index = i;
    wish.thetas = ValueRange{here.high + step, here.high + 0.3};
    outside.constraints.push_back(wish);
    wish.thetas->low = here.high - step;
    across.constraints.push_back(wish);
    const auto none = fit(reference_series(), outside), some = fit(reference_series(), across);
    ASSERT_FALSE(none) << i;
    EXPECT_EQ(none.error().code, ErrorCode::kFixedDataContradict);
    EXPECT_EQ(none.error().index, static_cast<std::ptrdiff_t>(i));
    ASSERT_TRUE(some) << i << " " << to_line(some.error());
    EXPECT_TRUE(some->certificate.proved);
    expect_inside(some->contour, wish);
  }
}

/// All points at once, where holding one end after the other need not lead anywhere.
TEST(GivenRanges, ManyTogetherAreKept) {
  RegionJob centre;
  centre.rule = TangentRule::kCentral;
  const auto table = region_table(reference_series(), centre);
  ASSERT_TRUE(table);
  FitJob job;
  for (std::size_t i = 0; i < kTenPoints.size(); ++i) {
    PointConstraint wish;
    wish.index = i;
    const double theta = std::remainder(table->elements[i].theta, 2.0 * std::numbers::pi);
    wish.thetas = ValueRange{theta - 0.02 * kOneDegree, theta + 0.02 * kOneDegree};
    job.constraints.push_back(wish);
  }
  const auto f = fit(reference_series(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_TRUE(f->certificate.proved);
  EXPECT_EQ(f->certificate.vertices, 0);
  for (const PointConstraint& wish : job.constraints) expect_inside(f->contour, wish);
}

/// Integral of (d kappa / d s)^2 by many small steps.
double change_of(const Contour& contour) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (const Piece& piece : contour.pieces) {
    for (int k = 0; k < kSteps; ++k) {
      const Jet a = evaluate(piece, (k + 0.5) / kSteps);
      sum += curvature_rate(a) * curvature_rate(a) * norm(a.d1) / kSteps;
    }
  }
  return sum;
}

double largest_curvature(const Contour& contour) {
  double out = 0.0;
  for (const Joint& joint : contour.joints) out = std::max(out, std::abs(joint.element.kappa));
  return out;
}

/// Against the ranges that single values inside the given one leave.
TEST(GivenRanges, WhatTheyLeaveToOthersIsWhatTheirValuesLeave) {
  const auto analysis = analyse(kTenPoints);
  ASSERT_TRUE(analysis);
  const auto heading_at = [&](std::size_t at, const ChainConstraints& constraints) {
    const auto ranges = pipeline_detail::series_ranges(*analysis, constraints);
    return ranges ? (*ranges)[at].heading : std::nullopt;
  };
  const ValueRange kappas{-0.036, -0.031}, thetas{76.0 * kOneDegree, 79.0 * kOneDegree};
  for (const bool heading : {false, true}) {
    for (const std::size_t at : {std::size_t{3}, std::size_t{5}, std::size_t{7}}) {
      ChainConstraints whole;
      whole.fixed.resize(kTenPoints.size());
      (heading ? whole.fixed[4].thetas : whole.fixed[4].kappas) = heading ? thetas : kappas;
      const auto found = heading_at(at, whole);
      ASSERT_TRUE(found);
      double low = HUGE_VAL, high = -HUGE_VAL;
      constexpr int kValues = 60;
      for (int k = 0; k <= kValues; ++k) {
        const ValueRange& range = heading ? thetas : kappas;
        const double value = range.low + (range.high - range.low) * k / kValues;
        ChainConstraints one;
        one.fixed.resize(kTenPoints.size());
        (heading ? one.fixed[4].theta : one.fixed[4].kappa) = value;
        const auto here = heading_at(at, one);
        if (!here) continue;
        low = std::min(low, here->low);
        high = std::max(high, here->high);
      }
      // the union of values inside lies inside, and comes as near as their steps are small
      EXPECT_GE(low, found->low - 1e-6);
      EXPECT_LE(high, found->high + 1e-6);
      EXPECT_NEAR(low, found->low, 1e-3);
      EXPECT_NEAR(high, found->high, 1e-3);
    }
  }
}

TEST(Preferences, LeastChangeChangesLessThanTheFairest) {
  FitJob least;
  least.prefer = Prefer::kLeastChange;
  const auto f = fit(reference_series(), least), fair = fit(reference_series(), {});
  ASSERT_TRUE(f && fair);
  EXPECT_TRUE(f->certificate.proved);
  EXPECT_LT(change_of(f->contour), change_of(fair->contour));
}

TEST(Preferences, NoContourHasALargestCurvatureMuchBelowTheLeast) {
  FitJob least;
  least.prefer = Prefer::kLeastCurvature;
  const auto f = fit(reference_series(), least);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_TRUE(f->certificate.proved);
  EXPECT_EQ(f->certificate.vertices, 0);
  const double most = largest_curvature(f->contour);
  EXPECT_LT(most, 0.95 * largest_curvature(fit(reference_series(), {})->contour));
  FitJob below;
  below.constraints.push_back(kappa_range(0, -0.98 * most, 0.98 * most));
  const auto none = fit(reference_series(), below);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kFixedDataContradict);
}

TEST(Preferences, TheCentreIsThatOfTheWorksheet) {
  FitJob centre;
  centre.prefer = Prefer::kCentre;
  RegionJob sheet;
  sheet.rule = TangentRule::kCentral;
  const auto f = fit(reference_series(), centre);
  const auto table = region_table(reference_series(), sheet);
  ASSERT_TRUE(f && table);
  for (const Joint& joint : f->contour.joints) {
    if (!joint.source) continue;
    EXPECT_NEAR(joint.element.theta, table->elements[*joint.source].theta, 1e-9);
  }
}

/// Twelve points of an ellipse, closed, the first one not at a vertex.
PointSeries twelve_of_an_ellipse() {
  PointSeries out;
  for (int i = 0; i < 12; ++i) {
    const double t = std::numbers::pi * i / 6.0 + 0.2;
    out.points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  return out;
}

TEST(Preferences, OfAClosedSeriesCloseAndKeepTheirWord) {
  const PointSeries series = twelve_of_an_ellipse();
  FitJob job;
  job.closing = Closing::kClosed;
  const auto fair = fit(series, job);
  ASSERT_TRUE(fair) << to_line(fair.error());
  job.prefer = Prefer::kCentre;
  const auto centre = fit(series, job);
  job.prefer = Prefer::kLeastCurvature;
  const auto least = fit(series, job);
  ASSERT_TRUE(centre && least);
  for (const auto* f : {&*centre, &*least}) {
    EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
    EXPECT_EQ(f->certificate.vertices, 4);
    EXPECT_EQ(f->certificate.curvature_steps, 0);
  }
  RegionJob sheet;
  sheet.job.closing = Closing::kClosed;
  sheet.rule = TangentRule::kCentral;
  const auto table = region_table(series, sheet);
  ASSERT_TRUE(table) << to_line(table.error());
  for (const Joint& joint : centre->contour.joints) {
    if (!joint.source) continue;
    EXPECT_NEAR(std::remainder(joint.element.theta - table->elements[*joint.source].theta,
                               2.0 * std::numbers::pi),
                0.0, 1e-9);
  }
  const double most = largest_curvature(least->contour);
  EXPECT_LT(most, largest_curvature(fair->contour));
  EXPECT_LT(most, largest_curvature(centre->contour));
  FitJob below;
  below.closing = Closing::kClosed;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    below.constraints.push_back(kappa_range(i, -0.98 * most, 0.98 * most));
  }
  const auto none = fit(series, below);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kFixedDataContradict);
}

TEST(Preferences, WithNoiseThereAreNone) {
  FitJob job;
  job.prefer = Prefer::kCentre;
  job.noise = 0.01;
  const auto none = fit(reference_series(), job);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kBadOption);
}

TEST(GivenRanges, AreKeptWithinTolerancesOfThePointsToo) {
  FitJob job;
  job.noise = 0.01;
  job.constraints.push_back(heading_range(4, 76.0, 78.0));
  job.end_kappas = ValueRange{-1.0 / 400.0, -1.0 / 500.0};
  const auto f = fit(reference_series(), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_EQ(f->report.given.heading_ranges, 1U);
  EXPECT_LE(f->report.given.heading_miss, kKeptTo);
  EXPECT_LE(f->report.given.curvature_miss, kKeptTo);
}

/// Two points have no adjacent circle, and radii open at one end: each preference has its curve.
TEST(Preferences, OfTwoPointsWithHeadingsAreMet) {
  PointSeries two;
  two.points = {{0.0, 0.0}, {10.0, 3.0}};
  two.fixed.resize(2);
  two.fixed[0].theta = 5.0 * kOneDegree;
  two.fixed[1].theta = 40.0 * kOneDegree;
  double fair = 0.0;
  for (const Prefer prefer :
       {Prefer::kFair, Prefer::kCentre, Prefer::kLeastChange, Prefer::kLeastCurvature}) {
    FitJob job;
    job.prefer = prefer;
    const auto made = fit(two, job);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
    EXPECT_LT(made->report.given.heading_miss, 1e-9);
    double largest = 0.0;
    for (const Joint& joint : made->contour.joints) {
      largest = std::max(largest, std::abs(joint.element.kappa));
    }
    if (prefer == Prefer::kFair) fair = largest;
    if (prefer == Prefer::kLeastCurvature) {
      EXPECT_LE(largest, fair);
    }
  }
}

}  // namespace
}  // namespace obvid
