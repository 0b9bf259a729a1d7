// SPDX-License-Identifier: Apache-2.0
// Every carrier through `fit` and beside the others: what each promises, on the reference series,
// on random series, around corners and loops; what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../common/angles.h"
#include "../common/long_runs.h"
#include "../common/oracle_curves.h"
#include "../common/ten_points.h"
#include "obvid/certify/certify.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/compare.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using namespace test;

Result<Fit> fit_with(Carrier carrier, const std::vector<Vec2>& points, FitJob job = {}) {
  PointSeries series;
  series.points = points;
  job.carrier = carrier;
  return fit(series, job);
}

/// Vertices of polynomial cubics by the signs of the curvature's rate at many places: another way
/// than the proof's.
int vertices_by_samples(const Contour& contour) {
  constexpr int kSamples = 20000;
  int count = 0, last = 0;
  for (const Piece& piece : contour.pieces) {
    for (int i = 1; i < kSamples; ++i) {
      const double rate = curvature_rate(evaluate(piece, static_cast<double>(i) / kSamples));
      const int sign = rate > 0.0 ? 1 : rate < 0.0 ? -1 : 0;
      if (sign == 0) continue;
      if (last != 0 && sign != last) ++count;
      last = sign;
    }
  }
  return count;
}

int inflections_by_samples(const Contour& contour) {
  constexpr int kSamples = 20000;
  int count = 0, last = 0;
  for (const Piece& piece : contour.pieces) {
    for (int i = 1; i < kSamples; ++i) {
      const double kappa = curvature(evaluate(piece, static_cast<double>(i) / kSamples));
      const int sign = kappa > 0.0 ? 1 : kappa < 0.0 ? -1 : 0;
      if (sign == 0) continue;
      if (last != 0 && sign != last) ++count;
      last = sign;
    }
  }
  return count;
}

TEST(Carriers, AllThatPromiseMonotoneCurvatureProveItOnTheReferenceSeries) {
  for (const Carrier carrier : kAllCarriers) {
    if (!promises_monotone(carrier)) continue;
    const auto f = fit_with(carrier, kTenPoints);
    ASSERT_TRUE(f) << to_string(carrier) << ": " << to_line(f.error());
    EXPECT_TRUE(f->certificate.proved) << to_string(carrier) << ": " << f->certificate.reason;
    EXPECT_EQ(f->certificate.vertices, 0) << to_string(carrier);
    EXPECT_LE(f->report.largest_width, f->report.tolerance) << to_string(carrier);
  }
}

TEST(Carriers, TheBaselineCountsItsVerticesAndInflectionsHonestly) {
  const auto f = fit_with(Carrier::kBaseline, kTenPoints);
  ASSERT_TRUE(f);
  EXPECT_FALSE(f->certificate.proved) << f->certificate.reason;
  EXPECT_TRUE(f->certificate.gaps_within_bounds);
  EXPECT_TRUE(f->certificate.through_points);
  EXPECT_EQ(f->certificate.vertices, vertices_by_samples(f->contour));
  EXPECT_EQ(f->certificate.inflections, inflections_by_samples(f->contour));
  EXPECT_EQ(f->certificate.vertices, 9);  // scipy's not-a-knot spline over chord length has as many
  EXPECT_EQ(f->certificate.inflections, 1);
}

TEST(Carriers, VerticesInsidePiecesAreCountedOnRandomPoints) {
  std::mt19937_64 rng(7);
  std::uniform_real_distribution<double> jitter(-0.35, 0.35);
  int vertices = 0;
  for (int k = 0; k < 30; ++k) {
    std::vector<Vec2> points;
    for (int i = 0; i < 12; ++i) points.push_back({i + jitter(rng), 2.0 * jitter(rng)});
    FitJob job;
    job.find_corners = false;
    const auto f = fit_with(Carrier::kBaseline, points, job);
    ASSERT_TRUE(f);
    EXPECT_EQ(f->certificate.vertices, vertices_by_samples(f->contour)) << k;
    EXPECT_EQ(f->certificate.inflections, inflections_by_samples(f->contour)) << k;
    vertices += f->certificate.vertices;
  }
  EXPECT_GT(vertices, 200);
}

TEST(Carriers, BsplineIsProvedOnRandomSeriesAndStaysWithinItsTolerance) {
  std::mt19937_64 rng(20260131);
  int proved = 0;
  const int kSeries = test::cases_of(600, 4);
  for (int i = 0; i < kSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    const auto f = fit_with(Carrier::kBspline, s.points);
    if (!f || !f->certificate.proved) continue;
    ++proved;
    EXPECT_EQ(f->certificate.vertices, 0);
    ASSERT_TRUE(f->report.carrier_deviation);
    EXPECT_LE(*f->report.carrier_deviation, f->report.tolerance);
    EXPECT_LE(f->certificate.largest_move, f->report.tolerance);
  }
  EXPECT_EQ(proved, kSeries);
}

TEST(Carriers, ConicsAndParabolasAreProvedOnRandomConvexSpirals) {
  std::mt19937_64 rng(99);
  for (const Carrier carrier : {Carrier::kConics, Carrier::kBeziers}) {
    int proved = 0;
    const int kSeries = test::cases_of(100, 2);
    for (int i = 0; i < kSeries; ++i) {
      const Oracle kinds[] = {Oracle::kLogSpiral, Oracle::kInvolute, Oracle::kParabola,
                              Oracle::kEllipse};
      const Sampled s = random_series(kinds[i % 4], rng, kRightAngle);
      const auto f = fit_with(carrier, s.points);
      if (f && f->certificate.proved && f->certificate.vertices == 0) {
        ++proved;
      } else if (f) {  // what is formed but not monotone says so
        EXPECT_FALSE(f->certificate.proved) << to_string(carrier) << i;
        EXPECT_FALSE(f->certificate.reason.empty()) << to_string(carrier) << i;
      }
    }
    EXPECT_GE(proved, kSeries * 95 / 100) << to_string(carrier);
  }
}

TEST(Carriers, WhatHasNoInflectionRefusesOneByNameOfThePoint) {
  std::vector<Vec2> points;
  for (int i = 0; i <= 12; ++i) {
    const double x = 0.3 * (i - 6);
    points.push_back({x, x * x * x / 12.0});
  }
  for (const Carrier carrier : {Carrier::kConics, Carrier::kBeziers}) {
    const auto f = fit_with(carrier, points);
    ASSERT_FALSE(f) << to_string(carrier);
    EXPECT_EQ(f.error().code, ErrorCode::kNoSpiral);
    EXPECT_NE(f.error().where.find("point "), std::string::npos) << f.error().where;
    EXPECT_NE(f.error().hint.find("--carrier"), std::string::npos);
  }
}

std::vector<Vec2> ellipse(int count) {
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    const double t = 2.0 * std::numbers::pi * (i + 0.37) / count;
    points.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  return points;
}

TEST(Carriers, GoAroundAClosedContour) {
  FitJob job;
  job.closing = Closing::kClosed;
  for (const Carrier carrier : kAllCarriers) {
    const auto f = fit_with(carrier, ellipse(36), job);
    if (carrier == Carrier::kConics) {  // headings are freed for open chains only
      ASSERT_FALSE(f);
      EXPECT_EQ(f.error().code, ErrorCode::kNoSpiral);
      continue;
    }
    ASSERT_TRUE(f) << to_string(carrier) << ": " << to_line(f.error());
    EXPECT_TRUE(f->contour.closed);
    EXPECT_EQ(f->contour.joints.size(), f->contour.pieces.size()) << to_string(carrier);
    EXPECT_TRUE(f->certificate.gaps_within_bounds) << to_string(carrier) << f->certificate.reason;
    EXPECT_TRUE(f->certificate.through_points) << to_string(carrier);
    if (promises_monotone(carrier)) {
      EXPECT_TRUE(f->certificate.proved) << to_string(carrier) << ": " << f->certificate.reason;
      EXPECT_EQ(f->certificate.vertices, 4) << to_string(carrier);
    }
  }
}

TEST(Carriers, KeepCorners) {
  // two arcs of parabolas that meet at a right angle
  std::vector<Vec2> points;
  for (int i = 0; i <= 8; ++i) points.push_back({0.25 * i - 2.0, -0.05 * (i - 9.0) * (i - 9.0)});
  for (int i = 1; i <= 8; ++i) points.push_back({0.02 * i * i, -0.05 - 0.25 * i});
  for (const Carrier carrier :
       {Carrier::kSpiral, Carrier::kBspline, Carrier::kCubic, Carrier::kBaseline}) {
    FitJob job;
    job.constraints.push_back({8, {}, {}, true});
    const auto f = fit_with(carrier, points, job);
    ASSERT_TRUE(f) << to_string(carrier) << ": " << to_line(f.error());
    EXPECT_EQ(f->certificate.corners, 1) << to_string(carrier);
    EXPECT_TRUE(f->certificate.gaps_within_bounds) << to_string(carrier);
  }
}

TEST(Carriers, OfStraightPointsAreTheLinesThemselvesWhateverTheirSlope) {
  for (const Vec2 step : {Vec2{1.0, 2.0}, Vec2{0.1, 0.3}, Vec2{-3.0, 0.7}, Vec2{1e-9, 3e-9}}) {
    std::vector<Vec2> points;
    for (int i = 0; i < 8; ++i) points.push_back(i * step);
    for (const Carrier carrier : kAllCarriers) {
      const auto f = fit_with(carrier, points);
      ASSERT_TRUE(f) << to_string(carrier) << ": " << to_line(f.error());
      EXPECT_TRUE(f->certificate.proved) << to_string(carrier) << ": " << f->certificate.reason;
      EXPECT_EQ(f->certificate.vertices, 0) << to_string(carrier);
    }
  }
}

TEST(Carriers, ASquareKeepsItsFourCorners) {
  const std::vector<Vec2> square = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2},
                                    {1, 2}, {0, 2}, {0, 1}, {0, 0}};
  for (const Carrier carrier : kAllCarriers) {
    const auto f = fit_with(carrier, square);
    ASSERT_TRUE(f) << to_string(carrier) << ": " << to_line(f.error());
    EXPECT_TRUE(f->certificate.proved) << to_string(carrier) << ": " << f->certificate.reason;
    EXPECT_EQ(f->certificate.vertices, 0) << to_string(carrier);
    EXPECT_EQ(f->certificate.corners, 4) << to_string(carrier);
  }
}

TEST(Carriers, ConicsOfACircleAreItsArcs) {
  std::vector<Vec2> arc, circle;
  for (int i = 0; i < 12; ++i) {
    const double t = 2.0 * std::numbers::pi * 0.4 * i / 12.0;
    arc.push_back({5.0 * std::cos(t), 5.0 * std::sin(t)});
  }
  for (int i = 0; i < 24; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 24.0;
    circle.push_back({10.0 * std::cos(t), 10.0 * std::sin(t)});
  }
  circle.push_back(circle.front());
  for (const auto& points : {arc, circle}) {
    const auto f = fit_with(Carrier::kConics, points);
    ASSERT_TRUE(f) << to_line(f.error());
    EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
    EXPECT_EQ(f->certificate.vertices, 0);
  }
}

TEST(Carriers, AreStoredAndVerifiedFromTheirFiles) {
  for (const Carrier carrier : kAllCarriers) {
    const auto f = fit_with(carrier, kTenPoints);
    ASSERT_TRUE(f) << to_string(carrier);
    const std::string text = contour_to_json({f->contour, f->report, f->certificate});
    const auto stored = contour_from_json(text, "test");
    ASSERT_TRUE(stored) << to_line(stored.error());
    EXPECT_EQ(stored->contour.carrier, carrier);
    EXPECT_EQ(contour_to_json(*stored), text) << to_string(carrier);
    const Verification v = verify(*stored);
    EXPECT_FALSE(v.false_claim) << to_string(carrier) << ": " << to_line(*v.false_claim);
    EXPECT_EQ(v.certificate.proved, promises_monotone(carrier));
  }
}

TEST(Carriers, AFileThatClaimsFewerVerticesThanTheBaselineHasIsFalse) {
  auto f = fit_with(Carrier::kBaseline, kTenPoints);
  ASSERT_TRUE(f);
  f->report.vertices -= 2;
  EXPECT_TRUE(verify({f->contour, f->report, f->certificate}).false_claim);
}

TEST(Compare, EveryCarrierHasItsRow) {
  PointSeries series;
  series.points = kTenPoints;
  const auto c = compare_carriers(series, {});
  ASSERT_TRUE(c);
  ASSERT_EQ(c->carriers.size(), kAllCarriers.size());
  for (const ComparedCarrier& row : c->carriers) {
    ASSERT_FALSE(row.refusal) << to_string(row.carrier);
    EXPECT_EQ(row.continuity, row.carrier == Carrier::kSpiral ? 3
                              : row.carrier == Carrier::kArcs ? 1
                                                              : 2)
        << to_string(row.carrier);
    EXPECT_EQ(row.followed, row.carrier == Carrier::kSpiral ? Continuity::kG3 : Continuity::kG2);
    EXPECT_GT(row.seconds, 0.0);
    EXPECT_EQ(row.fit.report.carrier_deviation.has_value(), row.carrier != Carrier::kSpiral);
  }
  EXPECT_EQ(c->carriers[0].control_points, 37U);  // 9 quartics
  EXPECT_EQ(c->carriers[2].control_points, 19U);  // 9 quadratics
  EXPECT_EQ(c->carriers[4].control_points, 0U);   // clothoids are no NURBS curves
  EXPECT_EQ(c->carriers[7].control_points, 12U);  // C2 cubic: points + 2
}

TEST(Compare, CarriersFollowSpiralsWithContinuousSlopes) {
  PointSeries series;
  series.points = kTenPoints;
  FitJob job;
  job.continuity = Continuity::kG3;
  const auto c = compare_carriers(series, job);
  ASSERT_TRUE(c);
  const auto spirals = fit(series, job);
  ASSERT_TRUE(spirals);
  for (const ComparedCarrier& row : c->carriers) {
    const std::string name = to_string(row.carrier);
    ASSERT_FALSE(row.refusal) << name;
    EXPECT_EQ(row.followed, Continuity::kG3) << name;
    EXPECT_EQ(row.fit.contour.continuity == Continuity::kG3, row.carrier == Carrier::kSpiral);
    EXPECT_EQ(row.continuity, row.carrier == Carrier::kSpiral ? 3
                              : row.carrier == Carrier::kArcs ? 1
                                                              : 2)
        << name;
    EXPECT_FALSE(verify({row.fit.contour, row.fit.report, row.fit.certificate}).false_claim)
        << name;
  }
  const Contour &first = c->carriers[0].fit.contour, &alone = spirals->contour;
  ASSERT_EQ(first.pieces.size(), alone.pieces.size());
  for (std::size_t i = 0; i < alone.pieces.size(); ++i) {
    EXPECT_EQ(evaluate(first.pieces[i], 0.5).point, evaluate(alone.pieces[i], 0.5).point);
  }
  // arcs stay within the tolerance of these spirals, not of the G2 ones, which are farther away
  const ComparedCarrier& arcs = c->carriers[1];
  EXPECT_LT(*arcs.fit.report.carrier_deviation, arcs.fit.report.tolerance);
  job.continuity = Continuity::kG2;
  const auto flat = fit(series, job);
  ASSERT_TRUE(flat);
  double away = 0.0;
  for (std::size_t i = 0; i < alone.pieces.size(); ++i) {
    away = std::max(away, norm(evaluate(flat->contour.pieces[i], 0.5).point -
                               evaluate(alone.pieces[i], 0.5).point));
  }
  EXPECT_GT(away, 10.0 * arcs.fit.report.tolerance);
}

TEST(Compare, DistancesOfAKnownCurveComeOut) {
  // points of a circle, one of them pushed in: spirals, and a baseline whose deviation is that of
  // the sampled distance between both contours
  PointSeries series;
  series.points = kTenPoints;
  FitJob job;
  job.continuity = Continuity::kG2;
  const auto c = compare_carriers(series, job);
  ASSERT_TRUE(c);
  const Contour& spirals = c->carriers[0].fit.contour;
  const Contour& baseline = c->carriers[7].fit.contour;
  double most = 0.0;
  for (const Piece& piece : baseline.pieces) {
    for (int i = 0; i <= 200; ++i) {
      const Vec2 p = evaluate(piece, i / 200.0).point;
      double least = 1e300;
      for (const Piece& other : spirals.pieces) {
        for (int j = 0; j <= 2000; ++j) {
          least = std::min(least, norm(evaluate(other, j / 2000.0).point - p));
        }
      }
      most = std::max(most, least);
    }
  }
  EXPECT_NEAR(*c->carriers[7].fit.report.carrier_deviation, most, 2e-3 * most);
}

TEST(Compare, ACarrierThatCannotDoItIsARowWithItsReason) {
  PointSeries series;
  for (int i = 0; i <= 12; ++i) {
    const double x = 0.3 * (i - 6);
    series.points.push_back({x, x * x * x / 12.0});
  }
  const auto c = compare_carriers(series, {});
  ASSERT_TRUE(c);
  EXPECT_TRUE(c->carriers[2].refusal);   // conics
  EXPECT_TRUE(c->carriers[3].refusal);   // parabolas
  EXPECT_FALSE(c->carriers[5].refusal);  // B-spline
}

/// Two arcs of parabolas that meet at a right angle in point 8.
PointSeries cornered() {
  PointSeries series;
  for (int i = 0; i <= 8; ++i) {
    series.points.push_back({0.25 * i - 2.0, -0.05 * (i - 9.0) * (i - 9.0)});
  }
  for (int i = 1; i <= 8; ++i) series.points.push_back({0.02 * i * i, -0.05 - 0.25 * i});
  return series;
}

TEST(Compare, BehindACornerTheRegionsAreThoseBehindIt) {
  FitJob job;
  job.constraints.push_back({8, {}, {}, true});
  const auto c = compare_carriers(cornered(), job);
  ASSERT_TRUE(c);
  for (const ComparedCarrier& row : c->carriers) {
    if (row.refusal) continue;
    const FitReport& report = row.fit.report;
    if (promises_monotone(row.carrier)) {
      EXPECT_LT(report.largest_deviation, 0.02)
          << to_string(row.carrier);  // chords are 0.25 and more
    }
    if (row.carrier == Carrier::kSpiral) continue;
    // the spirals lie in the regions: nothing is farther outside than it is from them
    EXPECT_LE(*report.outside_spirals_region, *report.carrier_deviation) << to_string(row.carrier);
  }
}

TEST(Compare, OutsideTheRegionOfACircleIsTheDistanceFromIt) {
  PointSeries series;
  series.points = {{0, 0}, {1, 5}, {1.1, 0}};  // the circle through three points, more than half
  FitJob job;
  job.find_corners = false;
  const auto c = compare_carriers(series, job);
  ASSERT_TRUE(c);
  const Fit& baseline = c->carriers[7].fit;
  EXPECT_GT(*baseline.report.carrier_deviation, 1.0);
  EXPECT_NEAR(*baseline.report.outside_spirals_region, *baseline.report.carrier_deviation, 1e-6);
  // by hand: the baseline's points from the centre
  const Vec2 centre = {0.55, 2.49};  // as far from (1, 5) as from (0, 0): 1.1 + 10 y = 26
  const double radius = norm(centre);
  double most = 0.0;
  for (const Piece& piece : baseline.contour.pieces) {
    for (int i = 0; i <= 1000; ++i) {
      most = std::max(most, std::abs(norm(evaluate(piece, i / 1000.0).point - centre) - radius));
    }
  }
  EXPECT_NEAR(*baseline.report.carrier_deviation, most, 1e-3 * most);
}

TEST(Compare, GivesTheCarriersThatWereDoneWhenItIsCancelled) {
  PointSeries series;
  for (int i = 0; i < 12; ++i) series.points.push_back({0.5 * i, 0.02 * i * i});
  std::string stage;
  const RunContext run([&stage](std::string_view told, double) { stage = told; },
                       [&stage] { return stage == to_string(Carrier::kConics); });
  Comparison finished;
  const auto c = compare_carriers(series, {}, run, &finished);
  ASSERT_FALSE(c);
  EXPECT_EQ(c.error().code, ErrorCode::kCancelled);
  ASSERT_EQ(finished.carriers.size(), 2U);  // spiral, arcs
  EXPECT_EQ(finished.carriers[0].carrier, Carrier::kSpiral);
  EXPECT_EQ(finished.carriers[1].carrier, Carrier::kArcs);
}

}  // namespace
}  // namespace obvid
