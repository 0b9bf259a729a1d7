// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/space_curve.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

/// A rational cubic with a double inner knot and uneven spans.
SpaceCurve uneven_curve() {
  return {
      3,
      {0, 0, 0, 0, 0.1, 0.5, 0.5, 0.503, 2, 2, 2, 2},
      {{0, 0, 0}, {1, 2, -1}, {2, 2, 3}, {3, -1, 1}, {5, 0, 0}, {5, 1, 2}, {7, 3, 1}, {8, 0, 0}},
      {1, 2, 0.5, 1, 3, 1, 1.5, 1}};
}

/// Weighted sum of B-splines straight from their recursive definition, to compare with.
double bspline(const std::vector<double>& t, std::size_t i, int p, double u) {
  if (p == 0) return t[i] <= u && u < t[i + 1] ? 1.0 : 0.0;
  const auto q = static_cast<std::size_t>(p);
  double sum = 0.0;
  if (t[i + q] > t[i]) sum += (u - t[i]) / (t[i + q] - t[i]) * bspline(t, i, p - 1, u);
  if (t[i + q + 1] > t[i + 1]) {
    sum += (t[i + q + 1] - u) / (t[i + q + 1] - t[i + 1]) * bspline(t, i + 1, p - 1, u);
  }
  return sum;
}

Vec3 by_definition(const SpaceCurve& c, double u) {
  Vec3 sum;
  double weight = 0.0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const double b = bspline(c.knots, i, c.degree, u) * (c.weights.empty() ? 1.0 : c.weights[i]);
    sum = sum + b * c.points[i];
    weight += b;
  }
  return sum / weight;
}

void expect_same_curve(const SpaceCurve& a, const SpaceCurve& b, double tolerance = 1e-13) {
  ASSERT_TRUE(check(b)) << check(b).error().what;
  const Range range = domain(a);
  for (int k = 0; k <= 200; ++k) {
    const double u = range.at(k / 200.0);
    const SpaceJet one = evaluate(a, u), two = evaluate(b, u);
    EXPECT_LT(norm(one.point - two.point), tolerance * 10) << u;
    // derivatives at a double knot are one-sided; the spans are the same on both curves
    EXPECT_LT(norm(one.d1 - two.d1), tolerance * (1 + norm(one.d1)) * 100) << u;
  }
}

TEST(SpaceCurve, IsTheSumOfItsBSplinesByTheirDefinition) {
  const SpaceCurve c = uneven_curve();
  for (const double u : {0.0, 0.05, 0.1, 0.3, 0.5, 0.501, 0.503, 1.0, 1.9999}) {
    EXPECT_LT(norm(evaluate(c, u).point - by_definition(c, u)), 1e-14) << u;
  }
  EXPECT_EQ(evaluate(c, 2.0).point, c.points.back());
}

TEST(SpaceCurve, DerivativesAgreeWithDifferences) {
  const SpaceCurve c = uneven_curve();
  const double h = 1e-4;
  for (const double u : {0.05, 0.3, 0.8, 1.5}) {
    const SpaceJet at = evaluate(c, u), up = evaluate(c, u + h), down = evaluate(c, u - h);
    EXPECT_LT(norm((up.point - down.point) / (2 * h) - at.d1), 1e-4 * norm(at.d1)) << u;
    EXPECT_LT(norm((up.d1 - down.d1) / (2 * h) - at.d2), 1e-4 * (1 + norm(at.d2))) << u;
    EXPECT_LT(norm((up.d2 - down.d2) / (2 * h) - at.d3), 1e-4 * (1 + norm(at.d3))) << u;
  }
}

TEST(SpaceCurve, BSplinesSumToOneAndTheirDerivativesToNothing) {
  const SpaceCurve c = uneven_curve();
  for (double u = 0.0; u < 2.0; u += 0.013) {
    const BasisValues b = basis_at(3, c.knots, u, 3);
    std::array<double, 4> sum{};
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t j = 0; j < 4; ++j) sum[r] += b.value[r][j];
    }
    EXPECT_NEAR(sum[0], 1.0, 1e-15);
    EXPECT_NEAR(sum[1], 0.0, 1e-10);  // slopes reach 1/0.003
    EXPECT_NEAR(sum[2], 0.0, 1e-7);
    EXPECT_NEAR(sum[3], 0.0, 1e-4);
  }
}

TEST(SpaceCurve, KnotsAreInsertedWithoutChangingTheCurve) {
  expect_same_curve(uneven_curve(),
                    with_knots(uneven_curve(), {0.0501, 0.1, 0.5, 0.5029, 1.0, 1.0, 1.0}));
  expect_same_curve(uneven_curve(), with_knots(uneven_curve(), {0.503, 0.503}));
}

TEST(SpaceCurve, DegreeIsRaisedWithoutChangingTheCurve) {
  for (int degree = 4; degree <= kMaxNurbsDegree; ++degree) {
    const SpaceCurve raised = with_degree(uneven_curve(), degree);
    EXPECT_EQ(raised.degree, degree);
    expect_same_curve(uneven_curve(), raised);
  }
}

TEST(SpaceCurve, DegreeIsRaisedOnSpansOfVeryUnevenLength) {
  SpaceCurve c = uneven_curve();
  c.knots = {0, 0, 0, 0, 1e-9, 0.5, 0.5 + 1e-7, 1.9, 2, 2, 2, 2};
  const SpaceCurve raised = with_degree(c, 6);
  for (int k = 0; k <= 1000; ++k) {
    EXPECT_LT(norm(evaluate(c, k / 500.0).point - evaluate(raised, k / 500.0).point), 1e-12) << k;
  }
}

TEST(SpaceCurve, SplitsIntoTwoPartsThatMeet) {
  for (const double u : {0.02, 0.1, 0.5, 0.7, 1.999}) {
    const auto [before, after] = split(uneven_curve(), u);
    ASSERT_TRUE(check(before)) << u;
    ASSERT_TRUE(check(after)) << u;
    EXPECT_EQ(before.points.back(), after.points.front());
    EXPECT_EQ(domain(before).to, u);
    EXPECT_EQ(domain(after).from, u);
    for (int k = 0; k <= 20; ++k) {
      const double a = domain(before).at(k / 20.0 * 0.999), b = domain(after).at(k / 20.0);
      EXPECT_LT(norm(evaluate(before, a).point - evaluate(uneven_curve(), a).point), 1e-13);
      EXPECT_LT(norm(evaluate(after, b).point - evaluate(uneven_curve(), b).point), 1e-13);
    }
  }
}

TEST(SpaceCurve, ReversedRunsBackwards) {
  const SpaceCurve back = reversed(uneven_curve());
  ASSERT_TRUE(check(back));
  for (int k = 0; k <= 50; ++k) {
    const double u = k / 25.0;
    EXPECT_LT(norm(evaluate(back, 2.0 - u).point - evaluate(uneven_curve(), u).point), 1e-13);
  }
}

TEST(SpaceCurve, CompatibleCurvesShareDegreeAndKnotsAndKeepTheirShape) {
  const SpaceCurve arc = arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2.0);
  const std::vector<SpaceCurve> in = {uneven_curve(), arc, line_between({0, 0, 0}, {1, 1, 1})};
  const std::vector<SpaceCurve> out = compatible(in);
  ASSERT_EQ(out.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(out[k].degree, 3);
    EXPECT_EQ(out[k].knots, out[0].knots);
    EXPECT_EQ(out[k].weights.size(), out[k].points.size());
    expect_same_curve(with_domain(in[k], {0, 1}), out[k]);
  }
}

TEST(SpaceCurve, ArcsLieOnTheirCircleWhateverTheirAngle) {
  const Vec3 axis = unit({1, 2, 3}), centre{5, -2, 1}, start = centre + Vec3{2, -1, 0} + 0.5 * axis;
  const double radius = norm(Vec3{2, -1, 0} - dot(Vec3{2, -1, 0}, axis) * axis);
  for (const double angle : {1e-6, 0.5, kPi / 2, kPi, 4.0, 2 * kPi, -1.0, -2 * kPi}) {
    const SpaceCurve arc = arc_about(start, centre, axis, angle);
    ASSERT_TRUE(check(arc)) << angle;
    EXPECT_LE(arc.points.size(), 9u);
    const Vec3 foot = centre + dot(start - centre, axis) * axis;
    for (int k = 0; k <= 100; ++k) {
      const Vec3 p = evaluate(arc, k / 100.0).point;
      EXPECT_NEAR(norm(p - foot), radius, 1e-14 * 10) << angle;
      EXPECT_NEAR(dot(p - foot, axis), 0.0, 1e-14 * 10) << angle;
    }
    const Vec3 x = start - foot, y = cross(axis, x);
    const Vec3 end = foot + std::cos(angle) * x + std::sin(angle) * y;
    EXPECT_LT(norm(evaluate(arc, 1.0).point - end), 1e-14 * 10) << angle;
    // second derivatives of coordinates of size 5 lose what the arc is shorter than them
    const double lost = 1e-15 * 10 / (angle * angle);
    EXPECT_NEAR(curvature(evaluate(arc, 0.3)), 1.0 / radius, 1e-13 + lost);
  }
  const SpaceCurve full = arc_about(start, centre, axis, 2 * kPi);
  EXPECT_EQ(full.points.front(), full.points.back());
}

TEST(SpaceCurve, InterpolationPassesThroughItsPointsAndReproducesCubics) {
  const auto cubic = [](double t) { return Vec3{t, t * t - 2 * t, t * t * t + 1}; };
  const std::vector<double> at = {0.0, 0.1, 0.15, 0.6, 0.61, 2.0, 3.0};
  std::vector<Vec3> points;
  for (const double t : at) points.push_back(cubic(t));
  const Result<SpaceCurve> curve = interpolated(points, at);
  ASSERT_TRUE(curve);
  for (double t = 0.0; t <= 3.0; t += 0.01) {
    EXPECT_LT(norm(evaluate(*curve, t).point - cubic(t)), 1e-13) << t;
  }
  for (std::size_t n = 2; n <= 4; ++n) {  // line, parabola, one cubic
    const Result<SpaceCurve> few =
        interpolated({points.begin(), points.begin() + static_cast<int>(n)},
                     {at.begin(), at.begin() + static_cast<int>(n)});
    ASSERT_TRUE(few);
    EXPECT_EQ(few->degree, static_cast<int>(n) - 1);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_LT(norm(evaluate(*few, at[i]).point - points[i]), 1e-14);
    }
  }
}

TEST(SpaceCurve, RefusesWhatIsNoCurve) {
  SpaceCurve c = uneven_curve();
  c.knots[5] = 0.05;
  EXPECT_EQ(check(c).error().code, ErrorCode::kBadOption);
  c = uneven_curve();
  c.weights[2] = 0.0;
  EXPECT_EQ(check(c).error().index, 2);
  c = uneven_curve();
  c.points.pop_back();
  EXPECT_EQ(check(c).error().code, ErrorCode::kBadOption);
  c = uneven_curve();
  c.points[3].y = std::nan("");
  EXPECT_EQ(check(c).error().code, ErrorCode::kNotFinite);
  c = uneven_curve();
  c.knots[0] = -1.0;
  EXPECT_EQ(check(c).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(interpolated({{0, 0, 0}, {1, 0, 0}}, {1.0, 1.0}).error().index, 1);
  EXPECT_EQ(interpolated({{0, 0, 0}}, {1.0}).error().code, ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace obvid
