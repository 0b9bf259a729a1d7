// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/pieces.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {
namespace {

/// Parabola (t, t^2) on [0, 1]: curvature 2 / (1 + 4 t^2)^(3/2).
RationalBezier parabola(Vec2 origin) {
  return {origin, 2, {Vec2{0.0, 0.0}, {0.5, 0.0}, {1.0, 1.0}}, {1.0, 1.0, 1.0}};
}

/// Quarter of the circle of radius 2, exact: weights 1, 1, 2.
RationalBezier quarter_circle() {
  return {{}, 2, {Vec2{2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}, {1.0, 1.0, 2.0}};
}

TEST(Pieces, TurningCountsFullTurnsAndBothSides) {
  constexpr double kPi = 3.14159265358979323846;
  EXPECT_EQ(turning_both_ways(LinePiece{{0, 0}, {3, 1}}, 0.0, 1.0), 0.0);
  const ArcPiece most_of_a_circle{{0, 0}, {1, 1}, 0.0, -1.0, 1.5 * kPi};
  EXPECT_NEAR(turning_both_ways(most_of_a_circle, 0.0, 1.0), 1.5 * kPi, 1e-15);
  EXPECT_NEAR(turning_both_ways(most_of_a_circle, 0.25, 0.75), 0.75 * kPi, 1e-15);
  // curvature -1 .. 3 along 8: a quarter of the way to one side, the rest to the other
  const ClothoidPiece both_ways{{0, 0}, {0, 0}, 0.0, -1.0, 3.0, 8.0};
  EXPECT_NEAR(turning_both_ways(both_ways, 0.0, 1.0), 0.5 * 2.0 + 0.5 * 3.0 * 6.0, 1e-14);
  EXPECT_NEAR(turning_both_ways(both_ways, 0.5, 1.0), 0.5 * (1.0 + 3.0) * 4.0, 1e-14);
  EXPECT_NEAR(turning_both_ways(parabola({0.0, 0.0}), 0.0, 1.0), std::atan(2.0), 1e-15);
  // y = 3 t - 9 t^2 + 6 t^3 over x = 3 t: slopes 1, -1/2, 1
  const RationalBezier wave{{}, 3, {Vec2{0, 0}, {1, 1}, {2, -1}, {3, 0}}, {1, 1, 1, 1}};
  EXPECT_NEAR(turning_both_ways(wave, 0.0, 1.0), 2.0 * (std::atan(1.0) + std::atan(0.5)), 1e-14);
}

TEST(Pieces, ParabolaHasItsClosedFormJet) {
  for (const double t : {0.0, 0.2, 0.5, 0.75, 1.0}) {
    const Jet jet = evaluate(parabola({0.0, 0.0}), t);
    EXPECT_NEAR(jet.point.x, t, 1e-16);
    EXPECT_NEAR(jet.point.y, t * t, 2e-16);
    EXPECT_NEAR(jet.d1.y, 2.0 * t, 5e-16);
    EXPECT_NEAR(jet.d2.y, 2.0, 1e-15);
    EXPECT_NEAR(norm(jet.d3), 0.0, 1e-15);
    const double q = 1.0 + 4.0 * t * t;
    EXPECT_NEAR(curvature(jet), 2.0 / std::pow(q, 1.5), 1e-14);
    EXPECT_NEAR(curvature_rate(jet), -24.0 * t / (q * q * q), 1e-13);
  }
}

TEST(Pieces, RationalQuarterCircleHasConstantCurvature) {
  for (int j = 0; j <= 16; ++j) {
    const Jet jet = evaluate(quarter_circle(), j / 16.0);
    EXPECT_NEAR(norm(jet.point), 2.0, 1e-15);
    EXPECT_NEAR(curvature(jet), 0.5, 1e-15);
    EXPECT_NEAR(curvature_rate(jet), 0.0, 2e-15);
  }
}

TEST(Pieces, CubicHasItsThirdDerivative) {
  // x = t, y = t^3: d3 = 6, kappa = 6 t / (1 + 9 t^4)^(3/2).
  const RationalBezier cubic{
      {}, 3, {Vec2{0, 0}, {1.0 / 3.0, 0}, {2.0 / 3.0, 0}, {1, 1}}, {1, 1, 1, 1}};
  const Jet jet = evaluate(cubic, 0.5);
  EXPECT_NEAR(jet.d3.y, 6.0, 1e-14);
  EXPECT_NEAR(curvature(jet), 3.0 / std::pow(1.0 + 9.0 / 16.0, 1.5), 1e-14);
}

TEST(Pieces, EndsAreMetExactly) {
  const RationalBezier piece{{1e3, -7.0},
                             4,
                             {Vec2{0.1, 0.2}, {0.3, 0.25}, {0.5, 0.4}, {0.6, 0.6}, {0.7, 0.9}},
                             {1.0, 0.9, 1.3, 1.1, 0.7}};
  EXPECT_EQ(evaluate(piece, 0.0).point, start_point(piece));
  EXPECT_EQ(evaluate(piece, 1.0).point, end_point(piece));
  const ArcPiece arc{{1, 2}, {3, 2}, 0.5, -0.4, 2.1};
  EXPECT_EQ(evaluate(arc, 0.0).point, arc.start);
  EXPECT_EQ(evaluate(arc, 1.0).point, arc.end);
  const LinePiece line{{1, 2}, {3, 2.7}};
  EXPECT_EQ(evaluate(line, 0.0).point, line.start);
  EXPECT_EQ(evaluate(line, 1.0).point, line.end);
}

TEST(Pieces, ASingularEndHasTheLimitOfHeadingsAndNoCurvature) {
  // both inner control points on the ends' neighbours: headings from the closed form of the limit
  const RationalBezier at_start{
      {75.0, 50.0}, 3, {Vec2{0, 0}, {0, 0}, {10, -15}, {-40, -25}}, {1, 1, 1, 1}};
  EXPECT_TRUE(is_singular_end(at_start, 0.0));
  EXPECT_FALSE(is_singular_end(at_start, 1.0));
  EXPECT_FALSE(is_singular_end(at_start, 0.5));
  EXPECT_NEAR(element_at(at_start, 0.0).theta, std::atan2(-15.0, 10.0), 1e-15);
  EXPECT_NEAR(element_at(at_start, 1e-9).theta, std::atan2(-15.0, 10.0), 1e-8);
  EXPECT_TRUE(std::isnan(element_at(at_start, 0.0).kappa));
  EXPECT_NEAR(element_at(at_start, 1.0).theta, std::atan2(-10.0, -50.0), 1e-15);
  const RationalBezier at_end{{}, 2, {Vec2{0.1, 0.3}, {3.3, 0.7}, {3.3, 0.7}}, {1.0, 0.7, 1.9}};
  EXPECT_TRUE(is_singular_end(at_end, 1.0));
  EXPECT_NEAR(element_at(at_end, 1.0).theta, std::atan2(0.4, 3.2), 1e-15);
  EXPECT_TRUE(std::isnan(element_at(at_end, 1.0).kappa));
  EXPECT_FALSE(is_singular_end(LinePiece{{0, 0}, {1, 0}}, 0.0));
}

TEST(Pieces, SmallPieceFarFromTheOriginKeepsItsCurvature) {
  const double size = 1e-7;
  RationalBezier piece = parabola({1e6, -3e6});
  for (Vec2& q : piece.offset) q = size * q;
  EXPECT_NEAR(curvature(evaluate(piece, 0.0)) * size, 2.0, 1e-14);
}

TEST(Pieces, ArcTurnsAtItsCurvature) {
  const double kappa = 0.25;
  const double length = 2.0 * kPi;  // a quarter turn of radius 4
  const ArcPiece arc{{0, 0}, {4, 4}, 0.0, kappa, length};
  EXPECT_NEAR(evaluate(arc, 0.5).point.x, 4.0 * std::sin(kPi / 4), 1e-14);
  EXPECT_NEAR(evaluate(arc, 0.75).point.y, 4.0 * (1.0 - std::cos(3 * kPi / 8)), 1e-14);
  EXPECT_NEAR(curvature(evaluate(arc, 0.3)), kappa, 1e-15);
  EXPECT_NEAR(curvature_rate(evaluate(arc, 0.3)), 0.0, 1e-15);
}

TEST(Pieces, LengthsAgreeWithClosedForms) {
  // Parabola (t, t^2): s = (2 sqrt 5 + asinh 2) / 4.
  EXPECT_NEAR(arc_length(parabola({}), 1e-13), (2.0 * std::sqrt(5.0) + std::asinh(2.0)) / 4.0,
              1e-13);
  EXPECT_NEAR(arc_length(quarter_circle(), 1e-13), kPi, 1e-13);
  EXPECT_NEAR(arc_length(LinePiece{{0, 0}, {3, 4}}, 1e-13), 5.0, 0.0);
}

TEST(Pieces, SplitHalvesTraceTheSameCurve) {
  const RationalBezier piece{{10, 20},
                             4,
                             {Vec2{0, 0}, {1, 0.1}, {2, 0.6}, {2.6, 1.5}, {2.7, 2.6}},
                             {1.0, 0.9, 1.3, 1.1, 0.7}};
  const double at = 0.3;
  const auto halves = split(piece, at);
  EXPECT_EQ(end_point(halves[0]), start_point(halves[1]));
  EXPECT_EQ(end_point(halves[1]), end_point(piece));
  for (const double t : {0.25, 0.5, 0.9}) {
    const Vec2 left = evaluate(halves[0], t).point - evaluate(piece, at * t).point;
    const Vec2 right = evaluate(halves[1], t).point - evaluate(piece, at + (1 - at) * t).point;
    EXPECT_LT(norm(left), 1e-14);
    EXPECT_LT(norm(right), 1e-14);
  }
}

TEST(Pieces, ManyPlacesAtOnceGiveTheBitsOfEachAlone) {
  RationalBezier piece{{1e3, -7.0},
                       kMaxBezierDegree,
                       {Vec2{0, 0}, {1, 0.1}, {2, 0.6}, {2.6, 1.5}, {2.7, 2.6}, {2.5, 3}, {2, 4},
                        {1, 4.4}},
                       {1.0, 0.9, 1.3, 1.1, 0.7, 1.2, 0.8, 1.7}};
  const std::vector<double> t = {0.0, 0.1, 0.3, 0.5, 0.4, 0.6, 0.7, 0.8, 1.0, 0.2, 0.9};
  for (int degree = 1; degree <= kMaxBezierDegree; ++degree) {
    piece.degree = degree;
    std::vector<Jet> jets(t.size());
    evaluate(piece, t, jets);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const Jet alone = evaluate(piece, t[i]);
      EXPECT_EQ(jets[i].point, alone.point) << degree << ", t = " << t[i];
      EXPECT_EQ(jets[i].d1, alone.d1) << degree << ", t = " << t[i];
      EXPECT_EQ(jets[i].d2, alone.d2) << degree << ", t = " << t[i];
      EXPECT_EQ(jets[i].d3, alone.d3) << degree << ", t = " << t[i];
    }
  }
}

TEST(Contour, CarriersHaveTheNamesOfTheFileFormat) {
  EXPECT_STREQ(to_string(Carrier::kSpiral), "spiral");
  EXPECT_STREQ(to_string(Carrier::kArcs), "arcs");
}

}  // namespace
}  // namespace obvid
