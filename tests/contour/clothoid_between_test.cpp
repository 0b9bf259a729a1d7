// SPDX-License-Identifier: Apache-2.0
// G1 Hermite by one clothoid: millions of random data, closed forms, and the minimisation of
// [002] as an independent way to the same curve.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../common/angles.h"
#include "clothoid_data.h"
#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"

namespace obvid {
namespace {

using namespace test;

double wrapped(double angle) { return std::remainder(angle, 2.0 * kPi); }

TEST(ClothoidBetween, NeverFailsOnMillionsOfRandomHeadings) {
  std::mt19937_64 rng(21);
  double worst = 0.0;
  for (int i = 0; i < 2000000; ++i) {
    // half of the data within half a turn, half near the chord
    const double range = i % 2 == 0 ? kPi : std::pow(10.0, uniform_between(rng, -8.0, 0.0));
    const double alpha = uniform_between(rng, -range, range);
    const double beta = uniform_between(rng, -range, range);
    const auto p = clothoid_between({0, 0}, alpha, {1, 0}, beta);
    ASSERT_TRUE(p.has_value()) << alpha << " " << beta;
    ASSERT_GE(p->length, 1.0 - 1e-15);
    // a loop of many chords multiplies what rounding does to its headings
    const Vec2 end = clothoid_step(alpha, p->kappa0, p->kappa1, p->length);
    worst = std::max(worst, norm(end - Vec2{1, 0}) / p->length);
    worst = std::max(worst, std::abs(wrapped(end_heading(*p) - beta)));
  }
  EXPECT_LE(worst, 1e-14);
}

TEST(ClothoidBetween, MeetsItsEndByQuadratureToo) {
  std::mt19937_64 rng(22);
  for (int i = 0; i < 20000; ++i) {
    const Vec2 start = {uniform_between(rng, -9, 9), uniform_between(rng, -9, 9)};
    const double h = std::pow(10.0, uniform_between(rng, -3.0, 3.0));
    const double omega = uniform_between(rng, -3.0, 3.0);
    const Vec2 end = start + h * unit_at(omega);
    const double theta0 = omega + uniform_between(rng, -2.5, 2.5) + 2.0 * kPi;
    const double theta1 = omega + uniform_between(rng, -2.5, 2.5) - 4.0 * kPi;
    const auto p = clothoid_between(start, theta0, end, theta1);
    ASSERT_TRUE(p.has_value());
    EXPECT_EQ(p->theta0, theta0);
    EXPECT_LE(end_miss(*p), 1e-13 * (h + norm(start) + norm(end)));
    EXPECT_NEAR(wrapped(end_heading(*p) - theta1), 0.0, 1e-13);
  }
}

TEST(ClothoidBetween, IsTheLineOrTheArcWhereTheHeadingsSaySo) {
  const auto line = clothoid_between({1, 1}, 0.25 * kPi, {2, 2}, 0.25 * kPi);
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->kappa0, 0.0, 1e-15);
  EXPECT_NEAR(line->kappa1, 0.0, 1e-15);
  EXPECT_NEAR(line->length, std::sqrt(2.0), 1e-15);
  for (const double half : {1e-9, 0.1, 1.0, 2.0, 3.0}) {
    const auto arc = clothoid_between({0, 0}, -half, {1, 0}, half);
    ASSERT_TRUE(arc.has_value());
    const double kappa = 2.0 * std::sin(half);
    EXPECT_NEAR(arc->kappa0, kappa, 1e-14) << half;
    EXPECT_NEAR(arc->kappa1, kappa, 1e-14) << half;
    EXPECT_NEAR(arc->length, 2.0 * half / kappa, 1e-14 * arc->length / kappa) << half;
  }
}

TEST(ClothoidBetween, ReversedAndMirroredDataGiveTheReversedAndMirroredCurve) {
  std::mt19937_64 rng(23);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = uniform_between(rng, -3, 3), beta = uniform_between(rng, -3, 3);
    const auto p = clothoid_between({0, 0}, alpha, {1, 0}, beta);
    const auto mirrored = clothoid_between({0, 0}, -alpha, {1, 0}, -beta);
    const auto reversed = clothoid_between({0, 0}, -beta, {1, 0}, -alpha);
    ASSERT_TRUE(p && mirrored && reversed);
    const double scale = 1e-13 * p->length * p->length;
    EXPECT_NEAR(mirrored->kappa0, -p->kappa0, scale);
    EXPECT_NEAR(mirrored->kappa1, -p->kappa1, scale);
    EXPECT_NEAR(reversed->kappa0, p->kappa1, scale);
    EXPECT_NEAR(reversed->kappa1, p->kappa0, scale);
  }
}

TEST(ClothoidBetween, RefusesPointsThatCoincideAndHeadingsThatAreNoNumbers) {
  EXPECT_FALSE(clothoid_between({1, 2}, 0.0, {1, 2}, 0.0).has_value());
  EXPECT_FALSE(clothoid_between({0, 0}, std::nan(""), {1, 0}, 0.0).has_value());
}

TEST(ClothoidBetween, HasAnAnswerWhereBothHeadingsPointHalfATurnFromTheChord) {
  for (const double alpha : {kPi, -kPi}) {
    for (const double beta : {kPi, -kPi}) {
      const auto p = clothoid_between({0, 0}, alpha, {1, 0}, beta);
      ASSERT_TRUE(p.has_value());
      EXPECT_NEAR(norm(clothoid_step(alpha, p->kappa0, p->kappa1, p->length) - Vec2{1, 0}), 0.0,
                  1e-13);
    }
  }
}

/// [002]: curvature a s + b; the end heading fixes a, the search of Hooke and Jeeves finds b and
/// the length S that bring the end point to its place.
class HookeJeeves {
 public:
  HookeJeeves(double alpha, double beta) : alpha_(alpha), beta_(beta) {}

  /// Start curvature and length.
  Vec2 run() const {
    const double half = 0.5 * (beta_ - alpha_);
    Vec2 base = {beta_ - alpha_, std::abs(half) > 1e-6 ? half / std::sin(half) : 1.0};
    double value = miss(base);
    for (double step = 0.25; step > 1e-13;) {
      double found_value = value;
      const Vec2 found = explore(base, step, found_value);
      if (found_value >= value) {
        step *= 0.5;
        continue;
      }
      base = follow(base, found, found_value, step, value);
    }
    return base;
  }

 private:
  double miss(Vec2 v) const {
    if (!(v.y > 0.0)) return HUGE_VAL;
    const double end_kappa = 2.0 * (beta_ - alpha_) / v.y - v.x;
    return norm(end_by_quadrature(alpha_, v.x, end_kappa, v.y) - Vec2{1, 0});
  }

  /// One step up or down along each axis, kept where it helps.
  Vec2 explore(Vec2 at, double step, double& value) const {
    for (const Vec2 axis : {Vec2{1, 0}, Vec2{0, 1}}) {
      for (const double side : {1.0, -1.0}) {
        const Vec2 tried = at + side * step * axis;
        const double there = miss(tried);
        if (there < value) {
          value = there;
          at = tried;
          break;
        }
      }
    }
    return at;
  }

  /// Leaps on in the direction that helped as long as it does.
  Vec2 follow(Vec2 base, Vec2 found, double found_value, double step, double& value) const {
    for (;;) {
      const Vec2 leap = found + (found - base);
      value = found_value;
      double leap_value = miss(leap);
      const Vec2 next = explore(leap, step, leap_value);
      if (leap_value >= value) return found;
      base = found;
      found = next;
      found_value = leap_value;
    }
  }

  double alpha_, beta_;
};

TEST(ClothoidBetween, AgreesWithTheMinimisationOfThePaperOnAThousandRandomData) {
  std::mt19937_64 rng(24);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = uniform_between(rng, -1.8, 1.8), beta = uniform_between(rng, -1.8, 1.8);
    const auto p = clothoid_between({0, 0}, alpha, {1, 0}, beta);
    ASSERT_TRUE(p.has_value());
    const Vec2 searched = HookeJeeves(alpha, beta).run();
    EXPECT_NEAR(p->kappa0, searched.x, 1e-9) << alpha << " " << beta;
    EXPECT_NEAR(p->length, searched.y, 1e-9) << alpha << " " << beta;
  }
}

}  // namespace
}  // namespace obvid
