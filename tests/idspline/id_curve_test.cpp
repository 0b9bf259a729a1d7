// SPDX-License-Identifier: Apache-2.0
// Curves over chord length against the circle and the helix.
#include "obvid/idspline/internal/id_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace obvid {
namespace {

using Point2 = std::array<double, 2>;
using Point3 = std::array<double, 3>;

constexpr IdSplineOptions kParabolas = {2, IdSmoothing::kValuesFree};

std::vector<Point3> helix(std::size_t spans) {
  std::vector<Point3> points;
  for (std::size_t i = 0; i <= spans; ++i) {
    const double t = 4.0 * std::numbers::pi * double(i) / double(spans);
    points.push_back({std::cos(t), std::sin(t), 0.2 * t});
  }
  return points;
}

/// Largest distance from the axis' unit cylinder.
double off_cylinder(const IdCurve<3>& curve) {
  double worst = 0.0;
  const double end = curve.part[0].nodes.back();
  for (int k = 0; k <= 5000; ++k) {
    const auto p = evaluate(curve, end * k / 5000.0).point;
    worst = std::max(worst, std::abs(std::hypot(p[0], p[1]) - 1.0));
  }
  return worst;
}

TEST(IdCurve, PassesThroughItsPointsUnlessValuesAreFree) {
  const auto points = helix(40);
  for (const int degree : {4, 6}) {
    const auto curve = id_curve<3>(points, {degree, IdSmoothing::kValuesKept});
    ASSERT_TRUE(curve);
    EXPECT_EQ(largest_move<3>(*curve, points), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(evaluate(*curve, curve->part[0].nodes[i]).point, points[i]) << i;
    }
  }
  const auto free = id_curve<3>(points, kParabolas);
  ASSERT_TRUE(free);
  const double move = largest_move<3>(*free, points);
  EXPECT_GT(move, 0.0);
  EXPECT_LT(move, 0.0105);  // fourth power of the step
}

TEST(IdCurve, HelixIsApproachedWithTheOrderOfTheDegree) {
  for (const int degree : {2, 4, 6}) {
    for (const auto smoothing : {IdSmoothing::kNone, IdSmoothing::kValuesFree}) {
      const double coarse = off_cylinder(*id_curve<3>(helix(64), {degree, smoothing}));
      const double fine = off_cylinder(*id_curve<3>(helix(128), {degree, smoothing}));
      EXPECT_GT(std::log2(coarse / fine), degree + 0.5) << degree;  // degree + 1 in the limit
    }
  }
}

TEST(IdCurve, ParameterIsTheChordLengthSummedUp) {
  const std::vector<Point2> points = {{0.0, 0.0}, {3.0, 4.0}, {3.0, 5.0}, {8.0, 17.0}};
  const auto curve = id_curve<2>(points);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->part[1].nodes, (std::vector<double>{0.0, 5.0, 6.0, 19.0}));
}

TEST(IdCurve, TurnsWithItsPoints) {
  const auto points = helix(30);
  const double c = 0.6, s = 0.8;
  std::vector<Point3> turned;
  for (const auto& p : points) turned.push_back({c * p[0] - s * p[2], p[1], s * p[0] + c * p[2]});
  const auto a = id_curve<3>(points), b = id_curve<3>(turned);
  for (const double u : {0.1, 3.3, 7.9}) {
    const auto p = evaluate(*a, u), q = evaluate(*b, u);
    EXPECT_NEAR(q.point[0], c * p.point[0] - s * p.point[2], 1e-12);
    EXPECT_NEAR(q.point[2], s * p.point[0] + c * p.point[2], 1e-12);
    EXPECT_NEAR(q.d1[1], p.d1[1], 1e-12);
  }
}

TEST(IdCurve, RefusesPointsThatMakeNoCurve) {
  using P = std::vector<Point2>;
  const auto code = [](const P& points) { return id_curve<2>(points).error().code; };
  EXPECT_EQ(code(P{}), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code(P{{0.0, 0.0}, {0.0, 0.0}}), ErrorCode::kChordReversal);
  EXPECT_EQ(code(P{{0.0, 0.0}, {0.0, std::nan("")}}), ErrorCode::kNotFinite);
  EXPECT_EQ(code(P{{-1e308, 0.0}, {1e308, 0.0}}), ErrorCode::kSizeOutOfRange);
}

}  // namespace
}  // namespace obvid
