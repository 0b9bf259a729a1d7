// SPDX-License-Identifier: Apache-2.0
// The closed-form spiral: end data, monotone curvature, nearness to the clothoid, limits, parts.
#include "obvid/contour/spirals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "../common/extended_curvature.h"
#include "../common/oracle_curves.h"
#include "obvid/certify/certify.h"

namespace obvid {
namespace {

using test::extended_curvature;
using test::uniform;

/// Headings of the ends, and curvatures times the chord: a few roundings of the control polygon.
constexpr double kSameEndHeading = 1e-13;
constexpr double kSameCurvature = 1e-11;

/// A link with these angles inside the closed form's cone by the factor `room` > 1; `skew` > 0 is
/// -A / B.
LinkState link_of(double h, double omega, double alpha, double sigma, double room, double skew) {
  LinkState link{h, omega, alpha, sigma - alpha, 0.0, 0.0, sigma};
  const double s = std::sin(sigma);
  const double product = room * s * s / (2.0 * std::cos(sigma));
  link.A = -std::sqrt(product * skew);
  link.B = std::sqrt(product / skew);
  return link;
}

LinkState mirrored_link(LinkState link) {
  for (double* v : {&link.omega, &link.alpha, &link.beta, &link.A, &link.B, &link.sigma}) *v = -*v;
  return link;
}

LinkState random_link(std::mt19937_64& rng) {
  const double h = std::pow(10.0, uniform(rng, -6.0, 6.0));
  return link_of(h, uniform(rng, -3.0, 3.0), uniform(rng, -1.0, 0.9),
                 std::pow(10.0, uniform(rng, -5.0, -0.05)), 1.0 + std::exp(uniform(rng, -2.0, 2.0)),
                 std::exp(uniform(rng, -1.0, 1.0)));
}

double start_kappa(const LinkState& l) { return 2.0 / l.h * (l.A - std::sin(l.alpha)); }
double end_kappa(const LinkState& l) { return 2.0 / l.h * (l.B + std::sin(l.beta)); }

void expect_end_data(const LinkState& l, Vec2 start, Vec2 end,
                     const std::vector<RationalBezier>& pieces, int i) {
  const RationalBezier &first = pieces.front(), &last = pieces.back();
  EXPECT_EQ(first.origin + first.offset[0], start) << i;
  EXPECT_EQ(last.offset[4], end - start) << i;
  for (const RationalBezier& p : pieces) {
    EXPECT_EQ(p.weight[0], 1.0);
    EXPECT_EQ(p.weight[4], 1.0);
    for (std::size_t j = 1; j < 4; ++j) EXPECT_GT(p.weight[j], 0.0) << i;
  }
  const Vec2 leave = first.offset[1] - first.offset[0], arrive = last.offset[4] - last.offset[3];
  // the chord stands for omega: it was rounded from it
  const Vec2 chord = end - start;
  EXPECT_NEAR(std::remainder(turning(chord, leave) - l.alpha, 2.0 * std::numbers::pi), 0.0,
              kSameEndHeading)
      << i;
  EXPECT_NEAR(std::remainder(turning(chord, arrive) - l.beta, 2.0 * std::numbers::pi), 0.0,
              kSameEndHeading)
      << i;
  EXPECT_NEAR(static_cast<double>(extended_curvature(first, 0.0L)) * l.h, start_kappa(l) * l.h,
              kSameCurvature)
      << i;
  EXPECT_NEAR(static_cast<double>(extended_curvature(last, 1.0L)) * l.h, end_kappa(l) * l.h,
              kSameCurvature)
      << i;
}

TEST(Spirals, MeetTheirEndDataAndAreMonotone) {
  std::mt19937_64 rng(21);
  int formed = 0;
  for (int i = 0; i < 3000; ++i) {
    const LinkState up = random_link(rng);
    const int direction = i % 2 == 0 ? 1 : -1;
    const LinkState l = direction > 0 ? up : mirrored_link(up);
    const Vec2 start = {l.h * uniform(rng, -1.0, 1.0), l.h * uniform(rng, -1.0, 1.0)};
    const Vec2 end = start + l.h * unit_at(l.omega);
    std::vector<RationalBezier> pieces;
    ASSERT_TRUE(append_spiral(l, direction, start, end, pieces)) << i;
    expect_end_data(l, start, end, pieces, i);
    ++formed;
    // below this the change of curvature drowns in the rounding of the control points
    constexpr double kVisible = 1e-7;
    if (l.B * direction - l.A * direction < kVisible) continue;
    long double last = -INFINITY;
    for (const RationalBezier& piece : pieces) {
      for (int k = 0; k <= 50; ++k) {
        const long double kappa = direction * extended_curvature(piece, k / 50.0L) * l.h;
        EXPECT_GT(kappa, last - kSameCurvature) << i;
        last = kappa;
      }
      const Verdict expected = direction > 0 ? Verdict::kIncreasing : Verdict::kDecreasing;
      EXPECT_EQ(prove_piece(piece).verdict, expected) << i;
    }
  }
  EXPECT_EQ(formed, 3000);
}

TEST(Spirals, AreRefusedOutsideTheClosedFormsCone) {
  std::vector<RationalBezier> pieces;
  const auto refused = [&](const LinkState& l, int direction) {
    EXPECT_FALSE(append_spiral(l, direction, {0, 0}, {1, 0}, pieces));
    EXPECT_TRUE(pieces.empty());
  };
  refused(link_of(1.0, 0.0, -0.2, 0.3, 0.999, 1.0), 1);
  refused(link_of(1.0, 0.0, -0.2, 0.3, 2.0, 1.0), -1);  // the other direction
  refused(mirrored_link(link_of(1.0, 0.0, -0.2, 0.3, 2.0, 1.0)), 1);
  LinkState turned = link_of(1.0, 0.0, -0.2, 0.3, 2.0, 1.0);
  turned.sigma = 1.6;  // beyond a right angle
  refused(turned, 1);
}

/// The clothoid theta = km s + kp s^2/2 for s from -L to L, as a link and as points.
struct Clothoid {
  double km, kp, L;

  [[nodiscard]] test::LongVec2 at(long double s) const {
    const test::OracleCurve c{test::Oracle::kClothoid, km, kp, 0.0L, 1.0L};
    return c.at(s);
  }
  [[nodiscard]] LinkState link() const {
    const auto a = at(-L), b = at(L);
    const long double dx = b.x - a.x, dy = b.y - a.y;
    const long double h = std::hypot(dx, dy), omega = std::atan2(dy, dx);
    const long double alpha = -km * L + kp * L * L / 2.0L - omega;
    const long double beta = km * L + kp * L * L / 2.0L - omega;
    LinkState l;
    l.h = static_cast<double>(h);
    l.omega = static_cast<double>(omega);
    l.alpha = static_cast<double>(alpha);
    l.beta = static_cast<double>(beta);
    l.sigma = static_cast<double>(alpha + beta);
    l.A = static_cast<double>((km - kp * L) * h / 2.0L + std::sin(alpha));
    l.B = static_cast<double>((km + kp * L) * h / 2.0L - std::sin(beta));
    return l;
  }
};

/// Largest distance of the closed form from the clothoid, across the chord.
double distance_from_clothoid(const Clothoid& c) {
  const LinkState l = c.link();
  const auto from = c.at(-c.L);
  const Vec2 u = unit_at(l.omega);
  std::vector<RationalBezier> pieces;
  EXPECT_TRUE(append_spiral(l, 1, {0.0, 0.0}, l.h * u, pieces));
  const auto local = [&](long double s) {
    const auto z = c.at(s);
    return Vec2{static_cast<double>((z.x - from.x) * u.x + (z.y - from.y) * u.y),
                static_cast<double>((z.y - from.y) * u.x - (z.x - from.x) * u.y)};
  };
  double worst = 0.0;
  for (const RationalBezier& piece : pieces) {
    for (int k = 1; k < 40; ++k) {
      const Vec2 p = evaluate(piece, k / 40.0).point;
      const double x = dot(u, p), y = cross(u, p);
      long double low = -c.L, high = c.L;
      for (int j = 0; j < 60; ++j) {
        const long double middle = (low + high) / 2.0L;
        (local(middle).x < x ? low : high) = middle;
      }
      worst = std::max(worst, std::abs(local((low + high) / 2.0L).y - y));
    }
  }
  return worst;
}

TEST(Spirals, ComeNearerToTheClothoidWithTheSixthPowerOfTheLength) {
  constexpr double kLeastOrder = 5.5;
  for (const auto& [km, kp] : {std::pair{0.4, 1.0}, {1.0, 1.0}, {-0.7, 0.8}, {0.9, 0.5}}) {
    std::vector<double> distance;
    for (const double L : {1.0, 0.5, 0.25, 0.125})
      distance.push_back(distance_from_clothoid({km, kp, L}));
    std::printf("clothoid %g + %g s: %.1e %.1e %.1e %.1e\n", km, kp, distance[0], distance[1],
                distance[2], distance[3]);
    // over three halvings: between two of them the leading term may happen to vanish
    EXPECT_GT(std::log2(distance.front() / distance.back()) / 3.0, kLeastOrder) << km;
  }
}

TEST(Spirals, BecomeTheCircleSmoothlyAsTheChangeOfCurvatureVanishes) {
  // A, B and sigma fall together; alpha = -beta stays: the arc of curvature 2 sin(alpha)/h
  for (const double alpha : {-0.8, -0.1, 0.0, 0.5}) {
    for (const double sigma : {1e-4, 1e-7, 1e-10, 1e-13}) {
      const LinkState l = link_of(1.0, 0.0, alpha + 0.5 * sigma, sigma, 4.0, 1.0);
      std::vector<RationalBezier> pieces;
      ASSERT_TRUE(append_spiral(l, 1, {0, 0}, {1, 0}, pieces)) << alpha << ", " << sigma;
      for (const RationalBezier& piece : pieces) {
        for (int k = 0; k <= 20; ++k) {
          const double kappa = static_cast<double>(extended_curvature(piece, k / 20.0L));
          EXPECT_NEAR(kappa, -2.0 * std::sin(alpha), 10.0 * sigma + kSameCurvature)
              << alpha << ", " << sigma;
        }
      }
    }
  }
}

TEST(Spirals, PiecesThatTurnFarComeInPartsOfTheSameCurve) {
  constexpr double kPartsFrom = 140.0 * std::numbers::pi / 180.0;
  int parted = 0;
  for (double alpha = -0.2; alpha > -1.45; alpha -= 0.05) {
    const LinkState l = link_of(1.0, 0.3, alpha, 0.2, 2.0, 1.0);
    const Vec2 end = unit_at(0.3);
    std::vector<RationalBezier> pieces;
    ASSERT_TRUE(append_spiral(l, 1, {0, 0}, end, pieces)) << alpha;
    expect_end_data(l, {0, 0}, end, pieces, 0);
    const double turn = l.beta - l.alpha;
    if (turn > kPartsFrom) {
      EXPECT_GE(pieces.size(), 2U) << alpha;
    } else if (turn < kPartsFrom - 0.1) {
      EXPECT_EQ(pieces.size(), 1U) << alpha;
    }
    parted += pieces.size() > 1 ? 1 : 0;
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
      const RationalBezier &a = pieces[i], &b = pieces[i + 1];
      EXPECT_LT(norm(a.offset[4] - b.offset[0]), 1e-15);
      EXPECT_NEAR(turning(a.offset[4] - a.offset[3], b.offset[1] - b.offset[0]), 0.0,
                  kSameEndHeading);
      EXPECT_NEAR(static_cast<double>(extended_curvature(a, 1.0L)),
                  static_cast<double>(extended_curvature(b, 0.0L)), kSameCurvature);
    }
  }
  EXPECT_GT(parted, 2);
}

TEST(Spirals, EveryPartTurnsByLessThanHalfATurnHoweverFarTheWholeDoes) {
  double farthest = 0.0;
  for (double alpha = -1.5; alpha > -2.9; alpha -= 0.1) {
    for (const double skew : {0.02, 1.0, 50.0}) {
      const LinkState l = link_of(1.0, 0.3, alpha, 0.2, 2.0, skew);
      std::vector<RationalBezier> pieces;
      if (!append_spiral(l, 1, {0, 0}, unit_at(0.3), pieces)) continue;
      farthest = std::max(farthest, l.beta - l.alpha);
      double sum = 0.0;
      for (const RationalBezier& piece : pieces) {
        double turn = 0.0;  // of the control polygon: no less than that of the curve
        for (std::size_t j = 1; j < 4; ++j) {
          turn +=
              turning(piece.offset[j] - piece.offset[j - 1], piece.offset[j + 1] - piece.offset[j]);
        }
        EXPECT_LT(std::abs(turn), std::numbers::pi) << alpha << ' ' << skew;
        sum += turn;
      }
      EXPECT_NEAR(sum, l.beta - l.alpha, 1e-9) << alpha << ' ' << skew;
    }
  }
  EXPECT_GT(farthest, 1.3 * std::numbers::pi);
}

}  // namespace
}  // namespace obvid
