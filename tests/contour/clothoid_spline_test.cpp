// SPDX-License-Identifier: Apache-2.0
// The G2 clothoid spline: the series of [000] as theory and prototype have it, curves that it
// must reproduce, continuity, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "../common/ten_points.h"
#include "clothoid_data.h"
#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"

namespace obvid {
namespace {

using namespace test;

TEST(ClothoidSpline, HasTheCurvaturesOfThePrototypeOnTheTenPoints) {
  const auto s = clothoid_spline(kTenPoints);
  ASSERT_TRUE(s.has_value());
  // a dense Newton method with finite differences, written in Python apart from this engine
  const double kappa[] = {-0.191,  -0.141,  -0.0739,  -0.0524,  -0.0297,
                          -0.0175, -0.0145, -0.00574, -0.00378, 0.00237};
  const double half_digit[] = {5e-4, 5e-4, 5e-5, 5e-5, 5e-5, 5e-5, 5e-5, 5e-6, 5e-6, 5e-6};
  ASSERT_EQ(s->elements.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(s->elements[i].kappa, kappa[i], half_digit[i]) << i;
    EXPECT_EQ(s->elements[i].point, kTenPoints[i]);
  }
}

void expect_continuous(const ClothoidSpline& s) {
  ASSERT_EQ(s.pieces.size() + 1, s.elements.size());
  for (std::size_t i = 0; i < s.pieces.size(); ++i) {
    const ClothoidPiece& p = s.pieces[i];
    const double size = norm(p.start) + norm(p.end) + p.length;
    EXPECT_LE(end_miss(p), 1e-13 * size) << i;
    EXPECT_NEAR(end_heading(p), s.elements[i + 1].theta, 1e-12) << i;
    EXPECT_EQ(p.kappa1, s.elements[i + 1].kappa) << i;
    EXPECT_EQ(p.kappa0, s.elements[i].kappa) << i;
  }
}

TEST(ClothoidSpline, IsContinuousUpToCurvature) {
  const auto s = clothoid_spline(kTenPoints);
  ASSERT_TRUE(s.has_value());
  expect_continuous(*s);
  const auto given = clothoid_spline(kTenPoints, {-1.9, -0.2});
  ASSERT_TRUE(given.has_value());
  expect_continuous(*given);
  EXPECT_NEAR(std::remainder(given->elements.front().theta + 1.9, 2.0 * std::numbers::pi), 0.0,
              1e-14);
  EXPECT_NEAR(std::remainder(given->elements.back().theta + 0.2, 2.0 * std::numbers::pi), 0.0,
              1e-14);
}

TEST(ClothoidSpline, NaturalEndsShareTheSharpnessOfTheChordBeside) {
  const auto s = clothoid_spline(kTenPoints);
  ASSERT_TRUE(s.has_value());
  const auto sharpness = [&](std::size_t i) {
    const ClothoidPiece& p = s->pieces[i];
    return (p.kappa1 - p.kappa0) / p.length;
  };
  EXPECT_NEAR(sharpness(0) / sharpness(1), 1.0, 1e-11);
  EXPECT_NEAR(sharpness(8) / sharpness(7), 1.0, 1e-11);
}

TEST(ClothoidSpline, ReproducesOneClothoidHoweverItIsSampled) {
  std::mt19937_64 rng(31);
  for (int i = 0; i < 200; ++i) {
    const Element start = {{3.0, -2.0}, uniform_between(rng, -3, 3), uniform_between(rng, -1, 1)};
    const double sharpness = uniform_between(rng, -1.5, 1.5);
    std::vector<Element> truth = {start};
    for (std::size_t k = 0; k < 3 + i % 8U; ++k) {
      truth.push_back(clothoid_at(truth.back(), sharpness, uniform_between(rng, 0.1, 0.6)));
    }
    std::vector<Vec2> points;
    for (const Element& e : truth) points.push_back(e.point);
    const auto s = clothoid_spline(points);
    ASSERT_TRUE(s.has_value()) << i;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      EXPECT_NEAR(std::remainder(s->elements[k].theta - truth[k].theta, 2.0 * std::numbers::pi),
                  0.0, 1e-11);
      EXPECT_NEAR(s->elements[k].kappa, truth[k].kappa, 1e-10);
    }
  }
}

TEST(ClothoidSpline, ThroughThreePointsIsTheirCircle) {
  const auto s = clothoid_spline({{2, 0}, {0, 2}, {-2, 0}});
  ASSERT_TRUE(s.has_value());
  for (const Element& e : s->elements) EXPECT_NEAR(e.kappa, 0.5, 1e-13);
}

TEST(ClothoidSpline, RefusesTooFewPointsAndChordsWithoutLength) {
  const auto few = clothoid_spline({{0, 0}, {1, 0}});
  ASSERT_FALSE(few.has_value());
  EXPECT_EQ(few.error().code, ErrorCode::kTooFewPoints);
  const auto twice = clothoid_spline({{0, 0}, {1, 0}, {1, 0}, {2, 1}});
  ASSERT_FALSE(twice.has_value());
  EXPECT_EQ(twice.error().code, ErrorCode::kChordReversal);
  EXPECT_EQ(twice.error().index, 1);
}

TEST(G1Clothoids, TakeTheHeadingsOfTheNeighbourRule) {
  const auto theta = neighbour_headings(kTenPoints, {-1.5, std::nullopt});
  ASSERT_EQ(theta.size(), kTenPoints.size());
  EXPECT_NEAR(theta.front(), -1.5, 1e-14);
  for (std::size_t i = 1; i + 1 < theta.size(); ++i) {
    const Vec2 chord = kTenPoints[i + 1] - kTenPoints[i - 1];
    EXPECT_NEAR(norm(unit_at(theta[i]) - chord / norm(chord)), 0.0, 1e-14) << i;
    EXPECT_LT(std::abs(theta[i] - theta[i - 1]), std::numbers::pi) << "unwrapped";
  }
  const auto pieces = g1_clothoids(kTenPoints, theta);
  ASSERT_TRUE(pieces.has_value());
  for (std::size_t i = 0; i < pieces->size(); ++i) {
    const ClothoidPiece& p = (*pieces)[i];
    EXPECT_LE(end_miss(p), 1e-12) << i;
    EXPECT_NEAR(std::remainder(end_heading(p) - theta[i + 1], 2.0 * std::numbers::pi), 0.0, 1e-13);
  }
  EXPECT_FALSE(g1_clothoids(kTenPoints, {0.0, 1.0}).has_value());
}

}  // namespace
}  // namespace obvid
