// SPDX-License-Identifier: Apache-2.0
// Two arcs between elements: end data, a common tangent, radii in order, nearly circular data.
#include "obvid/contour/arcs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "../common/oracle_curves.h"

namespace obvid {
namespace {

using test::uniform;

/// Positions relative to the chord. The length of an arc is its turning over its curvature, and the
/// turning of nearly straight arcs is known to a rounding of 1 only: their ends are that much
/// worse.
constexpr double kSamePlace = 1e-11;
constexpr double kPlacePerTurning = 1e-15;
/// A few roundings of sines near the joint.
constexpr double kSameHeading = 1e-12;

/// Two elements on a spiral of this direction: A, B inside the cone of existence by `room`.
std::array<Element, 2> elements_of(double h, double omega, double alpha, double sigma, double room,
                                   double skew, int direction) {
  const double half = std::sin(0.5 * sigma), product = room * half * half;
  const double A = -std::sqrt(product * skew), B = std::sqrt(product / skew);
  const double beta = sigma - alpha, d = direction;
  const Element a = {{0.3 * h, -0.2 * h}, omega + d * alpha, d * 2.0 / h * (A - std::sin(alpha))};
  return {a, Element{a.point + h * unit_at(omega), omega + d * beta,
                     d * 2.0 / h * (B + std::sin(beta))}};
}

struct ArcEnds {
  Vec2 start, end;  ///< where heading, curvature and length lead
  double theta0, theta1, kappa;
};

ArcEnds ends_of(const Piece& piece) {
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    const double turn = arc->kappa * arc->length;
    const double chord = turn == 0.0 ? arc->length : 2.0 * std::sin(0.5 * turn) / arc->kappa;
    return {arc->start, arc->start + chord * unit_at(arc->theta0 + 0.5 * turn), arc->theta0,
            arc->theta0 + turn, arc->kappa};
  }
  const auto& line = std::get<LinePiece>(piece);
  const double theta = heading(line.end - line.start);
  return {line.start, line.end, theta, theta, 0.0};
}

double between(double a, double b) { return std::remainder(a - b, 2.0 * std::numbers::pi); }

void expect_biarc(const Element& a, const Element& b, int direction, double place,
                  const std::string& what) {
  const auto k = choose_biarc(chord_frame(a, b), direction);
  ASSERT_TRUE(k) << what;
  EXPECT_GE(direction * (k->first - a.kappa), 0.0) << what;
  EXPECT_GE(direction * (k->second - k->first), 0.0) << what;
  EXPECT_GE(direction * (b.kappa - k->second), 0.0) << what;
  const auto arcs = biarc(a, b, *k);
  const ArcEnds first = ends_of(arcs[0]), second = ends_of(arcs[1]);
  const double h = norm(b.point - a.point);
  EXPECT_EQ(start_point(arcs[0]), a.point) << what;
  EXPECT_EQ(end_point(arcs[1]), b.point) << what;
  EXPECT_EQ(end_point(arcs[0]), start_point(arcs[1])) << what;
  EXPECT_LT(norm(first.end - second.start), place * h) << what;
  EXPECT_LT(norm(second.end - b.point), place * h) << what;
  EXPECT_NEAR(between(first.theta0, a.theta), 0.0, kSameHeading) << what;
  EXPECT_NEAR(between(first.theta1, second.theta0), 0.0, kSameHeading) << what;
  EXPECT_NEAR(between(second.theta1, b.theta), 0.0, kSameHeading) << what;
}

TEST(Arcs, MeetTheirElementsWithACommonTangentAndRadiiInOrder) {
  std::mt19937_64 rng(31);
  for (int i = 0; i < 5000; ++i) {
    const int direction = i % 2 == 0 ? 1 : -1;
    const auto [a, b] = elements_of(
        std::pow(10.0, uniform(rng, -6.0, 6.0)), uniform(rng, -3.0, 3.0), uniform(rng, -1.2, 1.2),
        std::pow(10.0, uniform(rng, -3.0, -0.2)), 1.0 + std::exp(uniform(rng, -3.0, 3.0)),
        std::exp(uniform(rng, -1.0, 1.0)), direction);
    expect_biarc(a, b, direction, kSamePlace, std::to_string(i));
  }
}

TEST(Arcs, MeetTheirElementsWhereTheseAreNearlyOneCircle) {
  for (const double alpha : {-1.0, -0.1, 0.0, 0.4}) {
    for (const double sigma : {1e-4, 1e-6, 1e-8}) {
      const auto [a, b] = elements_of(2.0, 0.7, alpha, sigma, 4.0, 1.0, 1);
      expect_biarc(a, b, 1, kPlacePerTurning / sigma + kSamePlace,
                   std::to_string(alpha) + ", " + std::to_string(sigma));
    }
  }
}

TEST(Arcs, OfOneCircleFollowIt) {
  // both elements on the unit circle, whatever curvature they are given around it
  const Element a = {{1.0, 0.0}, 0.5 * std::numbers::pi, 1.0};
  const Element b = {{std::cos(0.8), std::sin(0.8)}, 0.5 * std::numbers::pi + 0.8, 1.0};
  const auto arcs = biarc(a, b, {1.0, 1.0});
  for (const Piece& piece : arcs) {
    for (const double t : {0.0, 0.3, 0.7, 1.0}) {
      EXPECT_NEAR(norm(evaluate(piece, t).point), 1.0, kSamePlace);
    }
  }
}

TEST(Arcs, ThereAreNoneWhereNoSpiralExists) {
  const auto [a, b] = elements_of(1.0, 0.0, -0.3, 0.4, 0.9, 1.0, 1);
  EXPECT_FALSE(choose_biarc(chord_frame(a, b), 1));
  const auto [c, d] = elements_of(1.0, 0.0, -0.3, 0.4, 2.0, 1.0, 1);
  EXPECT_TRUE(choose_biarc(chord_frame(c, d), 1));
  EXPECT_FALSE(choose_biarc(chord_frame(c, d), -1));
}

TEST(Arcs, TheSecondCurvatureMakesTheBoundOfExistenceAnEquality) {
  // [Kurnosenko 2013]: A B + sin^2(sigma/2) = 0 exactly for one biarc
  std::mt19937_64 rng(32);
  for (int i = 0; i < 1000; ++i) {
    const double alpha = uniform(rng, -1.2, 1.2), beta = uniform(rng, -1.2, 1.2);
    const double h = std::exp(uniform(rng, -5.0, 5.0)), first = uniform(rng, -3.0, 3.0) / h;
    const ChordFrame f{h, unit_at(alpha), unit_at(beta), 0.0, 0.0};
    const double A = 0.5 * first * h + std::sin(alpha);
    const double B = 0.5 * second_curvature(f, first) * h - std::sin(beta);
    const double half = std::sin(0.5 * (alpha + beta));
    EXPECT_NEAR(A * B, -half * half, 1e-14 * (1.0 + std::abs(A * std::sin(beta)))) << i;
  }
}

TEST(Arcs, ThatAreOneCircleButForRoundingMeetHalfWay) {
  // points of a line in a series of size 1e4: the curvatures differ by 1e-24
  const Element start{{-1672.9548960637867, -1371.6693237174768}, -2.4548299381523524, 5.5e-18};
  const Element end{{-3345.9097921275584, -2743.338647434972}, -2.4548299381523417, 4.3e-18};
  const auto straight = biarc(start, end, {4.900407021343041e-18, 4.900405470815518e-18});
  const Vec2 middle = 0.5 * (start.point + end.point);
  EXPECT_LT(norm(end_point(straight[0]) - middle), 1e-11);
  // a quarter of the unit circle: the joint is on it at 45 degrees
  const double quarter = 0.5 * std::numbers::pi;
  const auto round =
      biarc({{1.0, 0.0}, quarter, 1.0}, {{0.0, 1.0}, 2.0 * quarter, 1.0}, {1.0, 1.0 + 0x1p-51});
  EXPECT_LT(norm(end_point(round[0]) - unit_at(0.5 * quarter)), 1e-15);
  EXPECT_NEAR(std::get<ArcPiece>(round[0]).length, 0.5 * quarter, 1e-15);
  EXPECT_NEAR(std::get<ArcPiece>(round[1]).length, 0.5 * quarter, 1e-15);
}

}  // namespace
}  // namespace obvid
