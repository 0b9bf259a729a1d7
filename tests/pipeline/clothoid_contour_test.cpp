// SPDX-License-Identifier: Apache-2.0
// Clothoid contours of 2,000 random series on exact curves: all proved, exact through the points,
// near the truth; and what the carrier keeps of fixed data and circular stretches.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "../common/angles.h"
#include "../common/long_runs.h"
#include "../common/oracle_curves.h"
#include "obvid/certify/certify.h"
#include "obvid/pipeline/fit.h"
#include "rounding_words.h"

namespace obvid {
namespace {

using namespace test;

const int kClothoidSeries = test::cases_of(2000, 8);
constexpr unsigned kClothoidSeed = 20260131;

Result<Fit> fit_clothoids(const std::vector<Vec2>& points, FitJob job = {}) {
  PointSeries series;
  series.points = points;
  job.carrier = Carrier::kClothoids;
  return fit(series, job);
}

/// Curvature linear on every piece (constant where points lie on one circle to rounding),
/// continuous, and strictly in the run's direction; every point is the end of a piece.
void expect_piecewise_linear(const Fit& f, const std::string& what) {
  const int direction = f.contour.runs.front().direction;
  double before = std::nan("");
  std::size_t next_point = 0, others = 0;
  for (std::size_t i = 0; i < f.contour.pieces.size(); ++i) {
    const auto* piece = std::get_if<ClothoidPiece>(&f.contour.pieces[i]);
    if (piece != nullptr) {
      EXPECT_GT(direction * (piece->kappa1 - piece->kappa0), 0.0) << what << ", piece " << i;
      if (!std::isnan(before)) {
        EXPECT_EQ(piece->kappa0, before) << what << ", piece " << i;
      }
    }
    others += piece == nullptr ? 1 : 0;
    before = piece != nullptr ? piece->kappa1 : std::nan("");
    if (f.contour.joints[i].source) {
      EXPECT_EQ(start_point(f.contour.pieces[i]), f.contour.points[next_point++]) << what;
    }
  }
  EXPECT_LE(others, 3U) << what << ": more than one stretch of points on a circle to rounding";
  EXPECT_EQ(end_point(f.contour.pieces.back()), f.contour.points[next_point]) << what;
  EXPECT_EQ(next_point + 1, f.contour.points.size()) << what;
}

TEST(ClothoidContour, IsProvedOnRandomSeries) {
  std::mt19937_64 rng(kClothoidSeed);
  int proved = 0;
  std::size_t pieces = 0, links = 0;
  for (int i = 0; i < kClothoidSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    const auto f = fit_clothoids(s.points);
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind) + ", " +
                             std::to_string(s.points.size()) + " points";
    if (!f || !f->certificate.proved || f->certificate.vertices != 0) {
      EXPECT_TRUE(speaks_of_rounding(f))
          << what << ": " << (f ? f->certificate.reason : f.error().what);
      continue;
    }
    ++proved;
    pieces += f->contour.pieces.size();
    links += s.points.size() - 1;
    EXPECT_LE(f->report.largest_width, f->report.tolerance) << what;
    EXPECT_LE(f->report.inflections, s.curve.kind == Oracle::kInflectedClothoid ? 1 : 0) << what;
    expect_piecewise_linear(*f, what);
  }
  std::printf("%d of %d proved, %.2f clothoids per chord\n", proved, kClothoidSeries,
              static_cast<double>(pieces) / static_cast<double>(links));
  EXPECT_GE(proved, kClothoidSeries * 99 / 100);
}

TEST(ClothoidContour, MeetsGivenHeadingsAndRadii) {
  FitJob job;
  job.start_heading = -1.08;
  job.start_kappa = -0.185;
  const auto f = fit_clothoids({{0, 0},
                                {0.21, -5.28},
                                {-5.11, -10.13},
                                {-20.48, -7.65},
                                {-28.68, 16.23},
                                {-13.87, 40.95},
                                {17.95, 55.28},
                                {54.24, 53.04},
                                {100.94, 36.19},
                                {230.38, -50.82}},
                               job);
  ASSERT_TRUE(f.has_value());
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
  const auto& first = std::get<ClothoidPiece>(f->contour.pieces.front());
  EXPECT_NEAR(first.theta0, -1.08, 1e-12);
  EXPECT_NEAR(first.kappa0, -0.185, 1e-12);
}

TEST(ClothoidContour, KeepsLinesAndArcsWhereThePointsLieOnThem) {
  // a straight stretch, a transition, a circular stretch of radius 2
  std::vector<Vec2> points = {{-4, 0}, {-3, 0}, {-2, 0}, {-1, 0}};
  for (const double turn : {0.6, 0.8, 1.0, 1.2, 1.4}) {
    points.push_back({0.2 + 2.0 * std::sin(turn), 2.02 - 2.0 * std::cos(turn)});
  }
  const auto f = fit_clothoids(points);
  ASSERT_TRUE(f.has_value()) << f.error().what;
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
  EXPECT_TRUE(std::holds_alternative<LinePiece>(f->contour.pieces.front()));
  const auto* last = std::get_if<ArcPiece>(&f->contour.pieces.back());
  ASSERT_NE(last, nullptr);
  EXPECT_NEAR(last->kappa, 0.5, 1e-12);
}

TEST(ClothoidContour, RefusedWhenOneNumberIsDoctored) {
  std::mt19937_64 rng(7);
  const Sampled s = random_series(Oracle::kLogSpiral, rng, kRightAngle);
  const auto good = fit_clothoids(s.points);
  ASSERT_TRUE(good && good->certificate.proved);
  const std::size_t middle = good->contour.pieces.size() / 2;
  using Change = void (*)(ClothoidPiece&);
  const Change changes[] = {[](ClothoidPiece& p) { p.theta0 += 1e-6; },
                            [](ClothoidPiece& p) { p.kappa0 *= 1.0 + 1e-6; },
                            [](ClothoidPiece& p) { p.kappa1 *= 1.0 - 1e-6; },
                            [](ClothoidPiece& p) { std::swap(p.kappa0, p.kappa1); },
                            [](ClothoidPiece& p) { p.length *= 1.0 + 1e-6; },
                            [](ClothoidPiece& p) { p.length = -p.length; },
                            [](ClothoidPiece& p) { p.start.x += 1e-6 * p.length; },
                            [](ClothoidPiece& p) { p.end.y += 1e-6 * p.length; }};
  for (const Change& change : changes) {
    Contour bad = good->contour;
    change(std::get<ClothoidPiece>(bad.pieces[middle]));
    EXPECT_FALSE(certify(bad).proved) << &change - &changes[0];
  }
}

}  // namespace
}  // namespace obvid
