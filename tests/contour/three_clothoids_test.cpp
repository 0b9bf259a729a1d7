// SPDX-License-Identifier: Apache-2.0
// Three clothoids over a link: end data, strictly monotone curvature, nearness to the curve that
// the data are from, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../common/oracle_curves.h"
#include "clothoid_data.h"
#include "obvid/contour/clothoids.h"
#include "turned_elements.h"

namespace obvid {
namespace {

using namespace test;

LinkState link_between(const Element& a, const Element& b) {
  LinkState link;
  const Vec2 chord = b.point - a.point;
  link.h = norm(chord);
  link.omega = heading(chord);
  link.alpha = std::remainder(a.theta - link.omega, 2.0 * std::acos(-1.0));
  link.beta = link.alpha + (b.theta - a.theta);
  link.sigma = link.alpha + link.beta;
  link.A = 0.5 * link.h * a.kappa + std::sin(link.alpha);
  link.B = 0.5 * link.h * b.kappa - std::sin(link.beta);
  return link;
}

/// Heading and curvature of the circle involute (radius t) and the logarithmic spiral.
Element element_on(const OracleCurve& c, long double t) {
  const LongVec2 p = c.at(t);
  Element e = {{static_cast<double>(p.x), static_cast<double>(p.y)}, 0.0, 0.0};
  const long double q = c.p;
  if (c.kind == Oracle::kInvolute) {
    e.theta = static_cast<double>(t);
    e.kappa = static_cast<double>(1.0L / t);
  } else {
    e.theta = static_cast<double>(t + std::atan2(1.0L, q));
    e.kappa = static_cast<double>(std::exp(-q * t) / std::sqrt(1.0L + q * q));
  }
  return e;
}

void expect_three(const Element& a, const Element& b, int direction,
                  std::vector<ClothoidPiece>& pieces) {
  pieces.clear();
  const LinkState link = link_between(a, b);
  ASSERT_TRUE(append_clothoids(link, direction, a, b, pieces));
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces.front().start, a.point);
  EXPECT_EQ(pieces.back().end, b.point);
  EXPECT_EQ(pieces.front().theta0, a.theta);
  EXPECT_EQ(pieces.front().kappa0, a.kappa);
  EXPECT_EQ(pieces.back().kappa1, b.kappa);
  EXPECT_NEAR(end_heading(pieces.back()), b.theta, 1e-13);
  const double size = norm(a.point) + norm(b.point);
  for (std::size_t j = 0; j < 3; ++j) {
    const ClothoidPiece& p = pieces[j];
    EXPECT_GT(p.length, 0.0);
    EXPECT_GT(direction * (p.kappa1 - p.kappa0), 0.0) << j;
    EXPECT_LE(end_miss(p), 1e-14 * (link.h + size)) << j;
    if (j == 0) continue;
    EXPECT_EQ(p.start, pieces[j - 1].end);
    EXPECT_EQ(p.kappa0, pieces[j - 1].kappa1);
    EXPECT_NEAR(end_heading(pieces[j - 1]), p.theta0, 1e-14 * (1.0 + std::abs(p.theta0)));
  }
}

TEST(ThreeClothoids, MeetTheElementsOfSpiralsWithStrictlyMonotoneCurvature) {
  std::mt19937_64 rng(41);
  std::vector<ClothoidPiece> pieces;
  for (int i = 0; i < 3000; ++i) {
    const bool involute = i % 2 == 0;
    OracleCurve c{involute ? Oracle::kInvolute : Oracle::kLogSpiral, 0.0L, 0.0L, 0.0L, 1.0L};
    c.p = uniform_between(rng, 0.05, 0.8);
    const double t = uniform_between(rng, 0.5, 3.0);
    const double turn = std::pow(10.0, uniform_between(rng, -1.5, 0.2));
    const Element a = element_on(c, t), b = element_on(c, t + turn);
    expect_three(a, b, -1, pieces);
    expect_three(mirrored(a), mirrored(b), 1, pieces);
    expect_three(reversed(b), reversed(a), -1, pieces);
    if (HasFatalFailure()) FAIL() << i << " turn " << turn;
  }
}

TEST(ThreeClothoids, ThroughElementsOfAClothoidAreThatClothoid) {
  std::vector<ClothoidPiece> pieces;
  const Element a = {{2.0, 1.0}, 0.3, -0.4};
  const double length = 1.7, kappa = 1.1;
  const Vec2 end = a.point + end_by_quadrature(a.theta, a.kappa, kappa, length);
  const Element b = {end, a.theta + 0.5 * (a.kappa + kappa) * length, kappa};
  expect_three(a, b, 1, pieces);
  for (const ClothoidPiece& p : pieces) {
    EXPECT_NEAR((p.kappa1 - p.kappa0) / p.length, (kappa - a.kappa) / length, 1e-12);
  }
}

/// Elements of arc, clothoid, arc: the curvature changes in the middle part only.
TEST(ThreeClothoids, AreFoundWhereTheCurvatureChangesOnAThirdOfTheLink) {
  std::vector<ClothoidPiece> pieces;
  for (const double first : {0.2, 0.5, 0.8}) {
    const double k0 = 0.3, k1 = 0.9, clothoid = 0.33, before = first * (1.0 - clothoid);
    const double after = 1.0 - clothoid - before;
    Element e = {{0.0, 0.0}, -0.3, k0};
    const auto go_on = [&e](double kappa, double length) {
      e.point = e.point + end_by_quadrature(e.theta, e.kappa, kappa, length);
      e.theta += 0.5 * (e.kappa + kappa) * length;
      e.kappa = kappa;
    };
    const Element a = e;
    go_on(k0, before);
    go_on(k1, clothoid);
    go_on(k1, after);
    expect_three(a, e, 1, pieces);
  }
}

TEST(ThreeClothoids, ThatTurnByHalfATurnComeInPartsOfTheSameClothoid) {
  // curvature rises soon, then hardly: the last clothoid takes nearly the whole turn
  const Element a = {{0.0, 0.0}, -1.6, 0.5};
  const double first = 0.3, rest = 2.6, knee = 1.0, last = 1.001;
  const Vec2 at_knee = end_by_quadrature(a.theta, a.kappa, knee, first);
  const double theta_knee = a.theta + 0.5 * (a.kappa + knee) * first;
  const Element b = {at_knee + end_by_quadrature(theta_knee, knee, last, rest),
                     theta_knee + 0.5 * (knee + last) * rest, last};
  std::vector<ClothoidPiece> pieces;
  ASSERT_TRUE(append_clothoids(link_between(a, b), 1, a, b, pieces));
  ASSERT_GT(pieces.size(), 3U);
  for (std::size_t j = 0; j < pieces.size(); ++j) {
    const ClothoidPiece& p = pieces[j];
    EXPECT_LT(0.5 * (p.kappa0 + p.kappa1) * p.length, 2.41) << j;
    EXPECT_GT(p.kappa1, p.kappa0) << j;
    EXPECT_LE(end_miss(p), 1e-14) << j;
    if (j == 0) continue;
    EXPECT_EQ(p.start, pieces[j - 1].end);
    EXPECT_EQ(p.kappa0, pieces[j - 1].kappa1);
    EXPECT_NEAR(p.theta0, end_heading(pieces[j - 1]), 1e-14);
  }
  const ClothoidPiece &p = pieces[pieces.size() - 2], &q = pieces.back();
  EXPECT_NEAR((p.kappa1 - p.kappa0) / p.length, (q.kappa1 - q.kappa0) / q.length, 1e-12);
  EXPECT_EQ(q.end, b.point);
}

TEST(ThreeClothoids, AreRefusedWhereNoSpiralExists) {
  std::vector<ClothoidPiece> pieces;
  const Element a = {{0.0, 0.0}, -0.2, 0.1};
  // a spiral of increasing curvature needs sigma > 0 and a curvature that increases
  const Element wrong_sigma = {{1.0, 0.0}, 0.1, 0.6}, falls = {{1.0, 0.0}, 0.3, 0.05};
  EXPECT_FALSE(append_clothoids(link_between(a, wrong_sigma), 1, a, wrong_sigma, pieces));
  EXPECT_FALSE(append_clothoids(link_between(a, falls), 1, a, falls, pieces));
  EXPECT_TRUE(pieces.empty());
}

}  // namespace
}  // namespace obvid
