// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/joined_nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace obvid {
namespace {

RationalBezier quadratic(Vec2 a, Vec2 b, Vec2 c, double w) {
  RationalBezier piece;
  piece.degree = 2;
  piece.offset = {a, b, c};
  piece.weight = {1.0, w, 1.0};
  return piece;
}

/// De Boor in homogeneous coordinates, written from the definition of the basis functions.
Vec2 evaluate_by_basis(const NurbsCurve& c, double t) {
  const auto basis = [&](auto&& self, std::size_t i, int p) -> double {
    if (p == 0) {
      const bool last = t == c.knots.back() && c.knots[i] < t && t == c.knots[i + 1];
      return (c.knots[i] <= t && t < c.knots[i + 1]) || last ? 1.0 : 0.0;
    }
    const auto q = static_cast<std::size_t>(p);
    const double left = c.knots[i + q] - c.knots[i], right = c.knots[i + q + 1] - c.knots[i + 1];
    return (left > 0.0 ? (t - c.knots[i]) / left * self(self, i, p - 1) : 0.0) +
           (right > 0.0 ? (c.knots[i + q + 1] - t) / right * self(self, i + 1, p - 1) : 0.0);
  };
  Vec2 sum;
  double weight = 0.0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const double b = c.weights[i] * basis(basis, i, c.degree);
    sum = sum + b * c.points[i];
    weight += b;
  }
  return sum / weight;
}

TEST(OneNurbs, RunsThroughThePiecesOfTheContour) {
  Contour contour;
  contour.pieces = {quadratic({0, 0}, {1, 0}, {2, 1}, 0.7), quadratic({2, 1}, {3, 2}, {3, 4}, 1.3),
                    quadratic({3, 4}, {3, 6}, {1, 7}, 1.0)};
  const auto curve = as_one_nurbs(contour);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->knots.size(), curve->points.size() + 3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double t : {0.0, 0.3, 0.8, 1.0}) {
      const Vec2 a = evaluate(contour.pieces[i], t).point;
      const Vec2 b = evaluate_by_basis(*curve, static_cast<double>(i) + t);
      EXPECT_NEAR(a.x, b.x, 1e-14);
      EXPECT_NEAR(a.y, b.y, 1e-14);
    }
  }
}

TEST(OneNurbs, TurnsAtCornersAndEndsWhereAClosedContourBegan) {
  Contour contour;
  contour.closed = true;
  contour.pieces = {quadratic({0, 0}, {2, -1}, {4, 0}, 0.7),
                    quadratic({4, 0}, {2, 3}, {0, 0}, 1.3)};
  const auto curve = as_one_nurbs(contour);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->points.front(), curve->points.back());
  // Left and right of the corner the curve follows the legs of the control polygon.
  constexpr double kStep = 1e-6;
  const Vec2 corner = evaluate_by_basis(*curve, 1.0);
  EXPECT_EQ(corner, (Vec2{4, 0}));
  const Vec2 in = corner - evaluate_by_basis(*curve, 1.0 - kStep);
  const Vec2 out = evaluate_by_basis(*curve, 1.0 + kStep) - corner;
  EXPECT_NEAR(std::atan2(in.y, in.x), std::atan2(1.0, 2.0), 1e-5);
  EXPECT_NEAR(std::atan2(out.y, out.x), std::atan2(3.0, -2.0), 1e-5);
  contour.pieces[1] = quadratic({4, 0}, {2, 3}, {0, 0.001}, 1.3);
  EXPECT_FALSE(as_one_nurbs(contour)) << "a closed contour with an open seam";
}

TEST(OneNurbs, NothingIsPromisedForArcsLooseEndsOrOtherWeights) {
  Contour contour;
  EXPECT_FALSE(as_one_nurbs(contour));
  contour.pieces = {quadratic({0, 0}, {1, 0}, {2, 1}, 0.7), LinePiece{{2, 1}, {3, 2}}};
  EXPECT_FALSE(as_one_nurbs(contour));
  contour.pieces[1] = quadratic({2, 1.5}, {3, 2}, {3, 4}, 1.0);
  EXPECT_FALSE(as_one_nurbs(contour));
  RationalBezier weighted = quadratic({2, 1}, {3, 2}, {3, 4}, 1.0);
  weighted.weight[2] = 2.0;
  contour.pieces[1] = weighted;
  EXPECT_FALSE(as_one_nurbs(contour));
  RationalBezier local = quadratic({0, 0}, {1, 1}, {1, 3}, 1.0);
  local.origin = {2, 1};
  contour.pieces[1] = local;
  EXPECT_FALSE(as_one_nurbs(contour));
}

}  // namespace
}  // namespace obvid
