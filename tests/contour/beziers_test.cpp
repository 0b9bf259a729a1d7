// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/beziers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "clothoid_data.h"
#include "turned_elements.h"

namespace obvid {
namespace {

using test::uniform_between;

constexpr double kMet = 1e-12;  // points in chords, headings in radians, curvatures relative
constexpr double kGap = 1e-10;  // of curvature, relative

/// Logarithmic spiral r = e^(b phi): curvature falls for b > 0.
Element log_spiral(double b, double phi) {
  const double r = std::exp(b * phi);
  return {r * unit_at(phi), phi + std::atan2(1.0, b), 1.0 / (r * std::hypot(1.0, b))};
}

/// Involute of the unit circle: heading t, curvature 1/t.
Element involute(double t) {
  return {{std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)}, t, 1.0 / t};
}

/// Curvature of a quadratic Bezier where it starts, from its legs: half their cross product over
/// the cube of the first one.
double start_curvature(const RationalBezier& p) {
  const Vec2 a = p.offset[1] - p.offset[0], b = p.offset[2] - p.offset[1];
  return 0.5 * cross(a, b) / std::pow(norm(a), 3.0);
}

double end_curvature(const RationalBezier& p) {
  const Vec2 a = p.offset[1] - p.offset[0], b = p.offset[2] - p.offset[1];
  return 0.5 * cross(a, b) / std::pow(norm(b), 3.0);
}

Vec2 first_leg(const RationalBezier& p) { return p.offset[1] - p.offset[0]; }
Vec2 last_leg(const RationalBezier& p) { return p.offset[2] - p.offset[1]; }

/// Sapidis and Frey: a quadratic has monotone curvature iff neither angle at the ends of its median
/// is obtuse, that is a.b >= min(|a|^2, |b|^2).
bool passes_sapidis_frey(const RationalBezier& p) {
  const Vec2 a = first_leg(p), b = last_leg(p);
  return dot(a, b) >= std::min(dot(a, a), dot(b, b));
}

void expect_parabola(const RationalBezier& p, int direction, const std::string& name) {
  ASSERT_EQ(p.degree, 2) << name;
  for (std::size_t j = 0; j < 3; ++j) EXPECT_EQ(p.weight[j], 1.0) << name;
  EXPECT_TRUE(passes_sapidis_frey(p)) << name;
  EXPECT_GT(direction * (end_curvature(p) - start_curvature(p)), 0.0) << name;
}

void expect_g2(const RationalBezier& p, const RationalBezier& q, const std::string& name) {
  const Vec2 a = last_leg(p), b = first_leg(q);
  EXPECT_EQ(p.origin + p.offset[2], q.origin + q.offset[0]) << name;
  EXPECT_NEAR(turning(a, b), 0.0, kGap) << name;
  EXPECT_NEAR(start_curvature(q) / end_curvature(p), 1.0, kGap) << name;
}

void expect_meets(Vec2 point, Vec2 leg, double kappa, const Element& e, double chord,
                  const std::string& name) {
  EXPECT_LE(norm(point - e.point), kMet * chord) << name;
  EXPECT_NEAR(turning(unit_at(e.theta), leg), 0.0, kMet) << name;
  EXPECT_NEAR(kappa / e.kappa, 1.0, kMet) << name;
}

void expect_chain(const Condensation& c, const Element& a, const Element& b, int direction,
                  const std::string& name) {
  const double h = norm(b.point - a.point);
  const auto& first = c.parabolas.front();
  const auto& last = c.parabolas.back();
  expect_meets(first.origin + first.offset[0], first_leg(first), start_curvature(first), a, h,
               name);
  expect_meets(last.origin + last.offset[2], last_leg(last), end_curvature(last), b, h, name);
  for (std::size_t i = 0; i < 4; ++i) {
    expect_parabola(c.parabolas[i], direction, name);
    if (i > 0) expect_g2(c.parabolas[i - 1], c.parabolas[i], name);
  }
  EXPECT_GT(c.margin, 0.0) << name;
}

TEST(Condensation, MeetsAThousandRandomDataWithMonotoneParabolas) {
  std::mt19937_64 rng(41);
  int found = 0, tried = 0;
  while (found < 1000 && tried < 4000) {
    ++tried;
    const double turn = std::exp(uniform_between(rng, std::log(0.02), std::log(1.0)));
    const double b = std::exp(uniform_between(rng, -1.0, 2.0));
    const double from = uniform_between(rng, 0.2, 2.0);
    Element p = tried % 2 == 0 ? log_spiral(b, 0.0) : involute(from);
    Element q = tried % 2 == 0 ? log_spiral(b, turn) : involute(from + turn);
    int direction = -1;
    if (tried % 3 == 0) {
      p = mirrored(p);
      q = mirrored(q);
      direction = 1;
    }
    const auto chain = condense(p, q, direction);
    if (!chain) continue;
    ++found;
    expect_chain(*chain, p, q, direction, "draw " + std::to_string(tried));
  }
  EXPECT_EQ(found, 1000);
  // curvature of these curves changes fast enough that four parabolas mostly do
  EXPECT_LT(tried, 2000);
}

TEST(Condensation, OfReversedDataIsTheReversedChain) {
  const Element p = log_spiral(1.0, 0.2), q = log_spiral(1.0, 0.6);
  // backwards the sign of curvature changes too: its value still falls, from -small to -large
  const auto there = condense(p, q, -1), again = condense(reversed(q), reversed(p), -1);
  ASSERT_TRUE(there && again);
  constexpr double kFlatMaximum = 1e-6;  // the best cut is known to half the digits
  EXPECT_NEAR(again->cut, there->cut, kFlatMaximum);
  EXPECT_NEAR(again->margin, there->margin, kFlatMaximum);
}

TEST(Condensation, NeedsAConvexLinkThatTurnsTheRightWay) {
  const Element p = log_spiral(1.0, 0.0), q = log_spiral(1.0, 0.3);
  ASSERT_TRUE(condense(p, q, -1));
  EXPECT_FALSE(condense(p, q, 1));  // curvature falls
  Element flat = q;
  flat.kappa = 0.0;
  EXPECT_FALSE(condense(p, flat, -1));
  flat.kappa = -0.1;
  EXPECT_FALSE(condense(p, flat, -1));
  EXPECT_FALSE(condense(mirrored(p), q, -1));
  EXPECT_FALSE(condense(p, p, -1));
}

TEST(Condensation, CannotCarryACircle) {
  // every parabola has a vertex at most at its end: four of them cannot have equal end radii
  const Element p = {{1.0, 0.0}, 0.5 * std::numbers::pi, 1.0};
  const Element q = {unit_at(0.3), 0.5 * std::numbers::pi + 0.3, 1.0};
  EXPECT_FALSE(condense(p, q, 1));
  EXPECT_FALSE(condense(p, q, -1));
}

/// Distance of a point from a clothoid piece, by its nearest of many points and one step of Newton.
double distance_to(const ClothoidPiece& piece, Vec2 p) {
  constexpr int kSteps = 400;
  double best = HUGE_VAL, at = 0.0;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double d = norm(evaluate(piece, t).point - p);
    if (d < best) {
      best = d;
      at = t;
    }
  }
  for (int k = 0; k < 3; ++k) {
    const Jet j = evaluate(piece, at);
    at = std::clamp(at + dot(p - j.point, j.d1) / dot(j.d1, j.d1), 0.0, 1.0);
  }
  return std::min(best, norm(evaluate(piece, at).point - p));
}

/// Clothoid of unit length.
ClothoidPiece clothoid(double theta, double kappa0, double kappa1) {
  return {{0.0, 0.0}, test::end_by_quadrature(theta, kappa0, kappa1, 1.0), theta, kappa0, kappa1,
          1.0};
}

void expect_within(const ParabolaChain& chain, const ClothoidPiece& piece, double tolerance,
                   const std::string& name) {
  EXPECT_LE(chain.width, tolerance) << name;
  constexpr double kRounding = 1e-15;  // of the unit length
  for (const RationalBezier& p : chain.parabolas) {
    for (const double t : {0.0, 0.3, 0.5, 0.7}) {
      const Vec2 point = evaluate(p, t).point;
      EXPECT_LE(distance_to(piece, point), chain.width + kRounding) << name;
    }
  }
}

TEST(CondensedPieces, StayWithinTheToleranceOfClothoids) {
  std::mt19937_64 rng(42);
  for (int i = 0; i < 60; ++i) {
    const double low = uniform_between(rng, 0.05, 1.0);
    const double high = low * std::exp(uniform_between(rng, 0.3, 2.0));
    const int sign = i % 2 == 0 ? 1 : -1, direction = i % 4 < 2 ? 1 : -1;
    const bool rises = sign == direction;  // in size
    const auto piece = clothoid(uniform_between(rng, -3.0, 3.0), sign * (rises ? low : high),
                                sign * (rises ? high : low));
    const double tolerance = std::pow(10.0, uniform_between(rng, -7.0, -2.0));
    const std::string name = "clothoid " + std::to_string(i);
    const auto chain = condense_piece(piece, direction, tolerance);
    ASSERT_TRUE(chain) << name << ": " << chain.error().what;
    ASSERT_EQ(chain->parabolas.size(), 4 * (chain->at.size() - 1)) << name;
    expect_within(*chain, piece, tolerance, name);
    for (std::size_t k = 0; k < chain->parabolas.size(); ++k) {
      expect_parabola(chain->parabolas[k], direction, name);
      if (k > 0 && k % 4 != 0) expect_g2(chain->parabolas[k - 1], chain->parabolas[k], name);
    }
    for (std::size_t k = 0; k < chain->at.size(); ++k) {
      const double t = chain->at[k];
      const double kappa = piece.kappa0 + t * (piece.kappa1 - piece.kappa0);
      const double found = k + 1 == chain->at.size() ? end_curvature(chain->parabolas.back())
                                                     : start_curvature(chain->parabolas[4 * k]);
      EXPECT_NEAR(found / kappa, 1.0, kGap) << name << " at " << t;
    }
  }
}

TEST(CondensedPieces, GrowFinerWithTheTolerance) {
  const auto piece = clothoid(0.0, 0.5, 3.0);
  std::size_t before = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const auto chain = condense_piece(piece, 1, tolerance);
    ASSERT_TRUE(chain);
    EXPECT_GE(chain->parabolas.size(), before);
    before = chain->parabolas.size();
  }
  // the region's width falls with the cube of the length: 1e6 finer takes a hundred times as many
  EXPECT_GT(before, 100u);
  EXPECT_LT(before, 1600u);
}

TEST(CondensedPieces, MeetTheElementsThatAreGivenForTheEnds) {
  const auto piece = clothoid(0.2, 0.5, 3.0);
  Element start = element_at(Piece{piece}, 0.0), end = element_at(Piece{piece}, 1.0);
  start.kappa *= 1.0 + 1e-5;
  end.kappa *= 1.0 - 1e-5;
  const auto chain = condense_piece(piece, start, end, 1, 1e-4);
  ASSERT_TRUE(chain);
  EXPECT_NEAR(start_curvature(chain->parabolas.front()) / start.kappa, 1.0, kGap);
  EXPECT_NEAR(end_curvature(chain->parabolas.back()) / end.kappa, 1.0, kGap);
}

TEST(CondensedPieces, SayWhyThereAreNone) {
  const auto inflected = condense_piece(clothoid(0.0, -0.5, 1.0), 1, 1e-3);
  ASSERT_FALSE(inflected);
  EXPECT_EQ(inflected.error().code, ErrorCode::kNoSpiral);
  const auto circle = condense_piece(clothoid(0.0, 1.0, 1.0), 1, 1e-3);
  ASSERT_FALSE(circle);
  EXPECT_EQ(circle.error().code, ErrorCode::kToleranceNotReached);
}

TEST(CurvaturesOfTriangles, AreThoseOfALogarithmicSpiral) {
  std::vector<Vec2> points;
  std::vector<double> headings, kappa;
  constexpr double kStep = 0.2;
  for (int i = 0; i < 12; ++i) {
    const Element e = log_spiral(1.0, kStep * i);
    points.push_back(e.point);
    headings.push_back(e.theta);
    kappa.push_back(e.kappa);
  }
  const auto found = curvatures_of_triangles(points, headings);
  ASSERT_EQ(found.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(found[i]) << i;
    // curvature linear in arc length has (b/a)^3 = kappa_0 / kappa_1 up to third order of the step
    EXPECT_NEAR(*found[i] / kappa[i], 1.0, 4.0 * kStep * kStep * kStep) << i;
    if (i == 0) continue;
    const Element before{points[i - 1], headings[i - 1], *found[i - 1]};
    EXPECT_TRUE(condense(before, {points[i], headings[i], *found[i]}, -1)) << i;
  }
}

TEST(CurvaturesOfTriangles, AreMissingWhereTheSeriesTurnsTheOtherWay) {
  // y = x^3: an inflection at the point in the middle, and none of the tangents elsewhere
  std::vector<Vec2> points;
  std::vector<double> headings;
  for (int i = -2; i <= 2; ++i) {
    const double x = 0.5 * i;
    points.push_back({x, x * x * x});
    headings.push_back(std::atan(3.0 * x * x));
  }
  const auto found = curvatures_of_triangles(points, headings);
  EXPECT_FALSE(found[2]);
  EXPECT_LT(found[1].value_or(0.0), 0.0);
  EXPECT_GT(found[3].value_or(0.0), 0.0);
}

TEST(CurvaturesOfTriangles, GoRoundAClosedSeries) {
  // a circle of radius 2 by eight points: 2 S / (a^3 b^3)^(1/2) with a = b = 2 tan(22.5 degrees)
  std::vector<Vec2> points;
  std::vector<double> headings;
  for (int i = 0; i <= 8; ++i) {
    const double t = 0.25 * std::numbers::pi * i;
    points.push_back({2.0 * std::cos(t), 2.0 * std::sin(t)});
    headings.push_back(t + 0.5 * std::numbers::pi);
  }
  const double side = 2.0 * std::tan(std::numbers::pi / 8.0);
  const double area = 0.5 * side * side * std::sin(std::numbers::pi / 4.0);
  for (const auto& kappa : curvatures_of_triangles(points, headings, true)) {
    ASSERT_TRUE(kappa);
    EXPECT_NEAR(*kappa, area / (side * side * side), 1e-13);
  }
}

}  // namespace
}  // namespace obvid
