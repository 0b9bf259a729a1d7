// SPDX-License-Identifier: Apache-2.0
// Monotone polynomial B-splines along proved contours: 2,000 random series on exact curves, the
// reference series, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "../common/angles.h"
#include "../common/long_runs.h"
#include "../common/oracle_curves.h"
#include "../common/ten_points.h"
#include "obvid/certify/certify.h"
#include "obvid/contour/bsplines/monotone.h"
#include "obvid/curve/nurbs.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using namespace test;

const int kSplineSeries = test::cases_of(2000, 4);
constexpr unsigned kSplineSeed = 20260131;
/// Tolerance against the size of the series: 0.3 mm on the reference series.
constexpr double kTolerance = 1e-3;

double diagonal_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return norm(high - low);
}

Result<Fit> fit_spirals(const std::vector<Vec2>& points) {
  PointSeries series;
  series.points = points;
  return fit(series, {});
}

/// The spline as a contour whose points are those of the series, each with the tolerance.
Contour as_contour(const MonotoneSpline& spline, const std::vector<Vec2>& points,
                   double tolerance) {
  Contour c;
  c.points = points;
  c.point_tolerance.assign(points.size(), tolerance);
  for (const Element& e : spline.elements) c.joints.push_back({e, std::nullopt, {}});
  for (std::size_t i = 0; i < spline.spans.size(); ++i) {
    c.pieces.emplace_back(spline.spans[i]);
    if (i > 0 && spline.direction[i] == spline.direction[i - 1]) {
      c.runs.back().last_piece = i;
    } else {
      c.runs.push_back({i, i, spline.direction[i]});
    }
  }
  return c;
}

/// Every span proved monotone from its own doubles, in the direction that is claimed.
int spans_not_proved(const MonotoneSpline& spline) {
  int bad = 0;
  for (std::size_t i = 0; i < spline.spans.size(); ++i) {
    const Verdict wanted = spline.direction[i] > 0   ? Verdict::kIncreasing
                           : spline.direction[i] < 0 ? Verdict::kDecreasing
                                                     : Verdict::kConstant;
    if (prove_piece(Piece{spline.spans[i]}).verdict != wanted) ++bad;
  }
  return bad;
}

double distance_between(const NurbsCurve& curve, const std::vector<RationalBezier>& spans) {
  double most = 0.0;
  const auto cut = bezier_spans(curve);
  EXPECT_EQ(cut.size(), spans.size());
  for (std::size_t i = 0; i < std::min(cut.size(), spans.size()); ++i) {
    for (std::size_t j = 0; j <= 5; ++j) {
      most = std::max(most, norm(cut[i].piece.offset[j] - spans[i].offset[j]));
    }
  }
  return most;
}

TEST(MonotoneBSpline, IsProvedOnRandomSeries) {
  std::mt19937_64 rng(kSplineSeed);
  int proved = 0, formed = 0;
  std::size_t control_points = 0, points = 0;
  for (int i = 0; i < kSplineSeries; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    const auto f = fit_spirals(s.points);
    if (!f || !f->certificate.proved) continue;
    const auto circular = [](const Piece& p) { return std::holds_alternative<ArcPiece>(p); };
    if (std::any_of(f->contour.pieces.begin(), f->contour.pieces.end(), circular)) continue;
    ++formed;
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind) + ", " +
                             std::to_string(s.points.size()) + " points";
    const double tolerance = kTolerance * diagonal_of(s.points);
    const auto spline = monotone_spline(f->contour, tolerance);
    if (!spline) {
      ADD_FAILURE() << what << ": " << spline.error().what << " at " << spline.error().where;
      continue;
    }
    EXPECT_EQ(spans_not_proved(*spline), 0) << what;
    const Certificate c = certify(as_contour(*spline, s.points, tolerance));
    EXPECT_TRUE(c.proved) << what << ": " << c.reason;
    EXPECT_EQ(c.vertices, f->certificate.vertices) << what;
    EXPECT_EQ(c.inflections, f->certificate.inflections) << what;
    EXPECT_LE(spline->deviation, tolerance) << what;
    proved += c.proved ? 1 : 0;
    control_points += spline->curve.points.size();
    points += s.points.size();
  }
  std::printf("%d of %d proved, %.2f control points per point\n", proved, formed,
              static_cast<double>(control_points) / static_cast<double>(points));
  EXPECT_GE(proved, kSplineSeries * 98 / 100);
}

TEST(MonotoneBSpline, IsOneCurveWithContinuousSecondDerivatives) {
  const auto f = fit_spirals(kTenPoints);
  ASSERT_TRUE(f);
  const auto spline = monotone_spline(f->contour, 1e-3);
  ASSERT_TRUE(spline);
  const NurbsCurve& curve = spline->curve;
  ASSERT_EQ(curve.points.size(), 3 * spline->spans.size() + 3);
  ASSERT_EQ(curve.knots.size(), curve.points.size() + 6);
  constexpr double kRounding = 1e-13;  // of the size, 281 mm
  EXPECT_LE(distance_between(curve, spline->spans), kRounding * 281.0);
  const auto spans = bezier_spans(curve);
  for (std::size_t i = 0; i + 1 < spans.size(); ++i) {
    const Jet a = evaluate(spans[i].piece, 1.0), b = evaluate(spans[i + 1].piece, 0.0);
    const double la = spans[i].to - spans[i].from, lb = spans[i + 1].to - spans[i + 1].from;
    EXPECT_LE(norm(a.d1 / la - b.d1 / lb), 1e-11) << i;
    EXPECT_NEAR(norm(a.d1 / la), 1.0, 1e-11) << i;  // arc length is its parameter at the knots
    EXPECT_LE(norm(a.d2 / (la * la) - b.d2 / (lb * lb)), 1e-10) << i;
  }
}

TEST(MonotoneBSpline, NeedsFewerKnotsForLargerTolerances) {
  // a quintic Hermite errs with the sixth power of its span: a thousand times finer takes about
  // 10^(3/6) = 3.2 times the spans, once accuracy and not monotony decides
  const auto f = fit_spirals(kTenPoints);
  ASSERT_TRUE(f);
  std::size_t before = 0;
  std::vector<double> growth;
  for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
    const auto spline = monotone_spline(f->contour, tolerance);
    ASSERT_TRUE(spline) << tolerance;
    EXPECT_LE(spline->deviation, tolerance);
    EXPECT_EQ(spans_not_proved(*spline), 0) << tolerance;
    if (before > 0) {
      growth.push_back(static_cast<double>(spline->spans.size()) / static_cast<double>(before));
    }
    before = spline->spans.size();
  }
  for (const double g : growth) {
    EXPECT_GT(g, 2.5);
    EXPECT_LT(g, 3.7);
  }
}

TEST(MonotoneBSpline, KeepsVerticesAndInflectionsOfTheContour) {
  // two runs and an inflection: a vertex at a knot, nowhere else
  std::vector<Vec2> points;
  for (int i = 0; i <= 16; ++i) points.push_back({0.25 * i, std::sin(0.25 * i)});
  const auto f = fit_spirals(points);
  ASSERT_TRUE(f && f->certificate.proved);
  ASSERT_GT(f->certificate.vertices, 0);
  const auto spline = monotone_spline(f->contour, 1e-4);
  ASSERT_TRUE(spline);
  const Certificate c = certify(as_contour(*spline, points, 1e-4));
  EXPECT_TRUE(c.proved) << c.reason;
  EXPECT_EQ(c.vertices, f->certificate.vertices);
  EXPECT_EQ(c.inflections, f->certificate.inflections);
}

TEST(MonotoneBSpline, GoesAroundAnEllipseWithItsFourVertices) {
  std::vector<Vec2> points;
  constexpr int kPoints = 24;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2.0 * std::numbers::pi * (i + 0.3) / kPoints;
    points.push_back({2.0 * std::cos(t), std::sin(t)});
  }
  PointSeries series;
  series.points = points;
  FitJob job;
  job.closing = Closing::kClosed;
  const auto f = fit(series, job);
  ASSERT_TRUE(f && f->certificate.proved && f->contour.closed);
  ASSERT_EQ(f->certificate.vertices, 4);
  const auto spline = monotone_spline(f->contour, 1e-5);
  ASSERT_TRUE(spline) << spline.error().what;
  EXPECT_EQ(spans_not_proved(*spline), 0);
  EXPECT_EQ(spline->curve.points.front(), spline->curve.points.back());
  Contour closed = as_contour(*spline, points, 1e-5);
  closed.closed = true;
  closed.joints.pop_back();
  const Certificate c = certify(closed);
  EXPECT_TRUE(c.proved) << c.reason;
  EXPECT_EQ(c.vertices, 4);
  EXPECT_EQ(c.inflections, 0);
}

TEST(MonotoneBSpline, RefusesArcsCornersAndNoTolerance) {
  const auto f = fit_spirals(kTenPoints);
  ASSERT_TRUE(f);
  EXPECT_EQ(monotone_spline(f->contour, 0.0).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(monotone_spline(f->contour, std::nan("")).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(monotone_spline(Contour{}, 1e-3).error().code, ErrorCode::kNothingThere);
  Contour corner = f->contour;
  corner.joints[4].leaving = corner.joints[4].element;
  const auto refused = monotone_spline(corner, 1e-3);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(refused.error().index, 4);
  Contour arc = f->contour;
  arc.pieces[3] = ArcPiece{{0, 0}, {1, 1}, 0.0, 1.0, 0.5 * std::numbers::pi};
  EXPECT_EQ(monotone_spline(arc, 1e-3).error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace obvid
