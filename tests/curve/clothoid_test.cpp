// SPDX-License-Identifier: Apache-2.0
// Clothoids against closed forms and against themselves; tests against arbitrary precision are in
// clothoid_reference_test.cpp.
#include "obvid/curve/internal/clothoid.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "obvid/curve/pieces.h"
#include "uniform.h"

namespace obvid {
namespace {

TEST(Clothoid, WithoutSharpnessIsTheLineOrTheArc) {
  const Vec2 line = clothoid_step(0.7, 0.0, 0.0, 3.0);
  EXPECT_NEAR(line.x, 3.0 * std::cos(0.7), 1e-15);
  EXPECT_NEAR(line.y, 3.0 * std::sin(0.7), 1e-15);
  for (const double turn : {1e-12, 1e-3, 0.9, 1.1, 3.0, 40.0}) {
    for (const double sign : {1.0, -1.0}) {
      const double radius = 2.0, length = turn * radius;
      const Vec2 z = clothoid_step(0.0, sign / radius, sign / radius, length);
      const double half = std::sin(0.5 * turn);
      EXPECT_NEAR(z.x, radius * std::sin(turn), 1e-14 * length) << turn;
      EXPECT_NEAR(z.y, sign * radius * 2.0 * half * half, 1e-14 * length) << turn;
    }
  }
}

TEST(Clothoid, FromItsInflectionHasTheFresnelIntegralsOfTheTables) {
  // Abramowitz and Stegun, table 7.7: C(x), S(x) with phase pi t^2/2, seven digits
  const struct {
    double x, c, s;
  } rows[] = {{0.5, 0.4923442, 0.0647324},
              {1.0, 0.7798934, 0.4382591},
              {2.0, 0.4882534, 0.3434157},
              {5.0, 0.5636312, 0.4991914}};
  for (const auto& row : rows) {
    const Vec2 z = clothoid_step(0.0, 0.0, kPi * row.x, row.x);
    EXPECT_NEAR(z.x, row.c, 1e-7) << row.x;
    EXPECT_NEAR(z.y, row.s, 1e-7) << row.x;
  }
}

TEST(Clothoid, EndsAtItsCentreAfterManyTurns) {
  // from the inflection to the centre: sqrt(pi/a)/2 (1, 1); the radius left is 1/kappa
  const double sharpness = 0.3, kappa = 1e5, s = kappa / sharpness;
  const Vec2 z = clothoid_step(0.0, 0.0, kappa, s);
  const double centre = 0.5 * std::sqrt(kPi / sharpness);
  EXPECT_NEAR(norm(z - Vec2{centre, centre}) * kappa, 1.0, 1e-8);
}

TEST(Clothoid, BackwardsLeadsBackToTheStart) {
  std::mt19937_64 rng(11);
  for (int i = 0; i < 2000; ++i) {
    const double theta = uniform(rng, -3.0, 3.0), s = uniform(rng, 0.1, 4.0);
    const double k0 = uniform(rng, -5.0, 5.0), k1 = uniform(rng, -5.0, 5.0);
    const Vec2 there = clothoid_step(theta, k0, k1, s);
    const Vec2 back = clothoid_step(theta + 0.5 * (k0 + k1) * s, k1, k0, -s);
    EXPECT_NEAR(norm(there + back), 0.0, 2e-14 * s);
  }
}

TEST(Clothoid, TwoPartsAreTheWhole) {
  std::mt19937_64 rng(12);
  for (int i = 0; i < 2000; ++i) {
    const Element start = {{0.0, 0.0}, uniform(rng, -3.0, 3.0), uniform(rng, -6.0, 6.0)};
    const double sharpness = uniform(rng, -9.0, 9.0), cut = uniform(rng, 0.0, 1.0);
    const Element middle = clothoid_at(start, sharpness, cut);
    const Element end = clothoid_at(middle, sharpness, 1.0 - cut);
    const Element whole = clothoid_at(start, sharpness, 1.0);
    EXPECT_NEAR(norm(end.point - whole.point), 0.0, 2e-14);
    EXPECT_NEAR(end.theta, whole.theta, 1e-14);
    EXPECT_NEAR(end.kappa, whole.kappa, 1e-14);
  }
}

TEST(Clothoid, WhatIsNoNumberStaysNone) {
  constexpr double kHuge = 1e300;
  EXPECT_FALSE(std::isfinite(clothoid_step(0.0, kHuge, -kHuge, kHuge).x));
  EXPECT_TRUE(std::isnan(clothoid_step(0.0, std::nan(""), 1.0, 1.0).x));
  EXPECT_TRUE(std::isnan(clothoid_step(std::nan(""), 1.0, 1.0, 5.0).y));
}

ClothoidPiece some_piece(double kappa0, double kappa1, double length) {
  const Vec2 start = {1.0, 2.0};
  return {start, start + clothoid_step(0.4, kappa0, kappa1, length), 0.4, kappa0, kappa1, length};
}

TEST(ClothoidPiece, EvaluatesToItsStoredEndsAndLength) {
  const Piece piece = some_piece(0.2, -1.5, 2.5);
  EXPECT_EQ(evaluate(piece, 0.0).point, start_point(piece));
  EXPECT_EQ(evaluate(piece, 1.0).point, end_point(piece));
  EXPECT_EQ(arc_length(piece, 1e-12), 2.5);
  EXPECT_NEAR(curvature(evaluate(piece, 0.0)), 0.2, 1e-15);
  EXPECT_NEAR(curvature(evaluate(piece, 1.0)), -1.5, 1e-15);
}

TEST(ClothoidPiece, HasLinearCurvatureAndDerivativesThatDifferencesConfirm) {
  for (const auto& piece : {some_piece(0.2, 3.0, 1.5), some_piece(-4.0, 2.0, 2.0)}) {
    const double rate = (piece.kappa1 - piece.kappa0) / piece.length;
    for (const double t : {0.1, 0.3, 0.49, 0.51, 0.8}) {
      const Jet jet = evaluate(piece, t);
      EXPECT_NEAR(curvature(jet), piece.kappa0 + rate * piece.length * t, 1e-14);
      EXPECT_NEAR(curvature_rate(jet), rate, 1e-13);
      constexpr double kStep = 1e-5;
      const Jet a = evaluate(piece, t - kStep), b = evaluate(piece, t + kStep);
      EXPECT_NEAR(norm((b.point - a.point) / (2.0 * kStep) - jet.d1), 0.0, 1e-7);
      EXPECT_NEAR(norm((b.d1 - a.d1) / (2.0 * kStep) - jet.d2), 0.0, 1e-6);
      EXPECT_NEAR(norm((b.d2 - a.d2) / (2.0 * kStep) - jet.d3), 0.0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace obvid
