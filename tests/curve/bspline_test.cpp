// SPDX-License-Identifier: Apache-2.0
// B-spline curves as Bezier spans, and cubic splines by points and slopes, against closed forms.
#include "obvid/curve/nurbs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "obvid/curve/internal/bspline_cubic.h"

namespace obvid {
namespace {

/// x = u, y = u^3 on uneven knots: its own cubic spline.
CubicSpline cube() {
  CubicSpline s;
  for (const double u : {-2.0, -1.5, 0.25, 0.5, 3.0}) {
    s.knots.push_back(u);
    s.points.push_back({u, u * u * u});
    s.slopes.push_back({1.0, 3.0 * u * u});
  }
  return s;
}

TEST(CubicSplineValue, ReproducesACubicWithAllDerivatives) {
  const CubicSpline s = cube();
  for (const double u : {-3.0, -2.0, -1.5, 0.0, 0.25, 0.4, 2.0, 3.0, 4.0}) {  // outside too
    const Jet jet = evaluate(s, u);
    EXPECT_NEAR(norm(jet.point - Vec2{u, u * u * u}), 0.0, 1e-12) << u;
    EXPECT_NEAR(norm(jet.d1 - Vec2{1.0, 3.0 * u * u}), 0.0, 1e-12) << u;
    EXPECT_NEAR(norm(jet.d2 - Vec2{0.0, 6.0 * u}), 0.0, 1e-11) << u;
    EXPECT_NEAR(norm(jet.d3 - Vec2{0.0, 6.0}), 0.0, 1e-11) << u;
  }
}

TEST(CubicSplineValue, SortedParametersGiveTheSamePointsInAnyOrder) {
  const CubicSpline s = cube();
  std::vector<double> u = {-2.5, -2.0, -1.9, -1.5, 0.3, 0.5, 2.9, 3.0, 3.5, 0.0, -2.0, 2.0};
  std::vector<Vec2> out(u.size());
  evaluate_sorted(s, u, out);
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_NEAR(norm(out[i] - Vec2{u[i], u[i] * u[i] * u[i]}), 0.0, 1e-12) << i;
  }
}

TEST(CubicSplineValue, BSplineHasTheBlossomsOfTheCubicAsControlPoints) {
  const NurbsCurve c = as_nurbs(cube());
  ASSERT_EQ(c.degree, 3);
  ASSERT_EQ(c.points.size(), 7u);
  ASSERT_EQ(c.knots.size(), 11u);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    // blossom of (u, u^3) at three neighbouring knots: mean and product
    const double a = c.knots[i + 1], b = c.knots[i + 2], d = c.knots[i + 3];
    EXPECT_NEAR(c.points[i].x, (a + b + d) / 3.0, 1e-13) << i;
    EXPECT_NEAR(c.points[i].y, a * b * d, 1e-12) << i;
    EXPECT_EQ(c.weights[i], 1.0);
  }
}

TEST(CubicSplineValue, BezierPiecesAreTheSpansOfItsBSpline) {
  const auto pieces = bezier_pieces(cube());
  const auto spans = bezier_spans(as_nurbs(cube()));
  ASSERT_EQ(pieces.size(), 4u);
  ASSERT_EQ(spans.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(spans[i].from, cube().knots[i]);
    EXPECT_EQ(spans[i].to, cube().knots[i + 1]);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_NEAR(norm(pieces[i].offset[j] - spans[i].piece.offset[j]), 0.0, 1e-12);
    }
  }
}

/// Full circle by four quadratic rational pieces (The NURBS Book, example 7.1).
NurbsCurve circle() {
  const double w = std::sqrt(0.5);
  return {2,
          {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
          {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}},
          {1, w, 1, w, 1, w, 1, w, 1}};
}

TEST(NurbsEvaluation, CircleHasRadiusAndCurvatureOne) {
  for (double u = 0.0; u <= 4.0; u += 0.0625) {
    const Jet jet = evaluate(circle(), u);
    EXPECT_NEAR(norm(jet.point), 1.0, 1e-15) << u;
    EXPECT_NEAR(curvature(jet), 1.0, 1e-13) << u;
    EXPECT_NEAR(curvature_rate(jet), 0.0, 1e-12) << u;
  }
}

TEST(NurbsEvaluation, SpansAreCircleQuartersThatShareTheirEnds) {
  const auto spans = bezier_spans(circle());
  ASSERT_EQ(spans.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(spans[i].piece.degree, 2);
    EXPECT_NEAR(arc_length(spans[i].piece, 1e-13), 0.5 * std::numbers::pi, 1e-12);
    if (i == 0) continue;
    EXPECT_EQ(spans[i].piece.offset[0], spans[i - 1].piece.offset[2]);
  }
}

/// Polynomial t^5 in both coordinates by its blossoms over knots of many multiplicities.
TEST(NurbsEvaluation, QuinticWithSimpleAndMultipleKnotsIsReproduced) {
  NurbsCurve c;
  c.degree = 5;
  c.knots = {0, 0, 0, 0, 0, 0, 0.5, 1, 1, 1, 1.25, 2, 2, 2, 2, 2, 2};
  for (std::size_t i = 0; i + 6 < c.knots.size(); ++i) {
    double sum = 0.0, product = 1.0;
    for (std::size_t j = i + 1; j <= i + 5; ++j) {
      sum += c.knots[j];
      product *= c.knots[j];
    }
    c.points.push_back({sum / 5.0, product});
    c.weights.push_back(1.0);
  }
  for (double u = 0.0; u <= 2.0; u += 0.05) {
    const Jet jet = evaluate(c, u);
    EXPECT_NEAR(norm(jet.point - Vec2{u, std::pow(u, 5)}), 0.0, 1e-13) << u;
    EXPECT_NEAR(jet.d2.y, 20.0 * std::pow(u, 3), 1e-11) << u;
    EXPECT_NEAR(jet.d3.y, 60.0 * u * u, 1e-10) << u;
  }
  EXPECT_EQ(bezier_spans(c).size(), 4u);
}

TEST(NurbsEvaluation, NumbersThatDoNotBelongTogetherGiveNoSpans) {
  NurbsCurve c = circle();
  c.weights.pop_back();
  EXPECT_TRUE(bezier_spans(c).empty());
  c = circle();
  c.knots.push_back(5.0);
  EXPECT_TRUE(bezier_spans(c).empty());
  c = circle();
  c.degree = 8;
  EXPECT_TRUE(bezier_spans(c).empty());
  EXPECT_TRUE(bezier_spans({}).empty());
}

}  // namespace
}  // namespace obvid
