// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/path_distance.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace obvid {
namespace {

using Pieces = std::vector<Piece>;

ArcPiece arc_around(Vec2 centre, double radius, double from, double turn) {
  return {centre + radius * unit_at(from), centre + radius * unit_at(from + turn),
          from + std::copysign(0.5 * kPi, turn), std::copysign(1.0 / radius, turn),
          radius * std::abs(turn)};
}

/// A bound of a true distance, and at most 0.1 % more.
void expect_bound(double bound, double truth) {
  EXPECT_GE(bound, truth * (1.0 - 1e-12));
  EXPECT_LE(bound, 1.001 * truth * (1.0 + 1e-12));
}

/// Cubic with these control points.
RationalBezier cubic(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  RationalBezier bezier;
  bezier.degree = 3;
  bezier.offset = {a, b, c, d};
  bezier.weight = {1.0, 1.0, 1.0, 1.0};
  return bezier;
}

TEST(PathDistance, OfAnArcAndItsChordIsTheSagitta) {
  const ArcPiece arc = arc_around({0.0, 0.0}, 5.0, 0.2, 1.1);
  const double sagitta = 5.0 * (1.0 - std::cos(0.55));
  expect_bound(path_distance(Pieces{arc}, Pieces{LinePiece{arc.start, arc.end}}), sagitta);
}

TEST(PathDistance, OfConcentricCirclesIsTheDifferenceOfTheirRadii) {
  const Pieces a = {arc_around({1.0, 2.0}, 5.0, 0.0, 2.0 * kPi)};
  const Pieces b = {arc_around({1.0, 2.0}, 5.25, 0.0, 3.0),
                    arc_around({1.0, 2.0}, 5.25, 3.0, 2.0 * kPi - 3.0)};
  expect_bound(path_distance(a, b), 0.25);
  expect_bound(path_distance(b, a), 0.25);
}

TEST(PathDistance, CountsBothWays) {
  // a detour of b to (1, 1): a is nowhere farther than sqrt(1/2) from b, but b is 1 from a
  const Pieces a = {LinePiece{{0.0, 0.0}, {2.0, 0.0}}};
  const Pieces b = {LinePiece{{0.0, 0.0}, {1.0, 1.0}}, LinePiece{{1.0, 1.0}, {2.0, 0.0}}};
  EXPECT_NEAR(path_distance(a, b), 1.0, 1e-12);
  EXPECT_NEAR(path_distance(b, a), 1.0, 1e-12);
}

TEST(PathDistance, FollowsBothSidesOfACorner) {
  const Pieces a = {LinePiece{{0.0, 0.0}, {1.0, 0.0}}, LinePiece{{1.0, 0.0}, {1.0, 1.0}}};
  const Pieces inside = {LinePiece{{0.0, 0.1}, {0.9, 0.1}}, LinePiece{{0.9, 0.1}, {0.9, 1.0}}};
  const Pieces outside = {LinePiece{{0.0, -0.1}, {1.1, -0.1}}, LinePiece{{1.1, -0.1}, {1.1, 1.0}}};
  EXPECT_NEAR(path_distance(a, inside), 0.1 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(path_distance(a, outside), 0.1 * std::numbers::sqrt2, 1e-12);
}

TEST(PathDistance, OfTheUsualCubicFromItsQuarterCircle) {
  // kappa = 4/3 (sqrt 2 - 1): radius 1 + 2.7253e-4 at most (Goldapp 1991)
  const double k = 4.0 / 3.0 * (std::numbers::sqrt2 - 1.0);
  const Pieces a = {cubic({1.0, 0.0}, {1.0, k}, {k, 1.0}, {0.0, 1.0})};
  const Pieces b = {arc_around({0.0, 0.0}, 1.0, 0.0, 0.5 * kPi)};
  // r(t)^2 = x^2 + y^2 is largest where its derivative is 0, found here by bisection
  const auto radius = [&](double t) {
    const double s = 1.0 - t;
    return std::hypot(s * s * s + 3.0 * s * s * t + 3.0 * s * t * t * k,
                      3.0 * s * s * t * k + 3.0 * s * t * t + t * t * t);
  };
  double low = 0.0, high = 0.5;
  for (int i = 0; i < 200; ++i) {  // unimodal between 0 and the middle
    const double a1 = low + (high - low) / 3.0, b1 = high - (high - low) / 3.0;
    (radius(a1) < radius(b1) ? low : high) = radius(a1) < radius(b1) ? a1 : b1;
  }
  const double truth = radius(low) - 1.0;
  EXPECT_NEAR(truth, 2.7253e-4, 1e-8);
  expect_bound(path_distance(a, b), truth);
}

TEST(PathDistance, BoundsWhatLiesBetweenAnyNumberOfPlaces) {
  // an arc over two chords: the larger sagitta lies anywhere between the places looked at first
  for (int k = 1; k < 60; ++k) {
    const double part = k / 60.0;  // of the arc, where the other path has its joint
    const ArcPiece whole = arc_around({0.0, 0.0}, 7.0, -0.4, 0.9);
    const Vec2 joint = evaluate(Piece{whole}, part).point;
    const Pieces chords = {LinePiece{whole.start, joint}, LinePiece{joint, whole.end}};
    const double larger = 0.45 * std::max(part, 1.0 - part);
    expect_bound(path_distance(Pieces{whole}, chords), 7.0 * (1.0 - std::cos(larger)));
  }
}

TEST(PathDistance, OfTheSameCurveCutInManyPiecesIsRounding) {
  RationalBezier rest = cubic({0.0, 0.0}, {0.02, 0.5}, {3.0, 1.0}, {3.2, -4.0});
  const Pieces whole = {rest};
  Pieces parts;
  for (int i = 0; i < 40; ++i) {
    const auto [first, second] = split(rest, 0.1);
    parts.emplace_back(first);
    rest = second;
  }
  parts.emplace_back(rest);
  EXPECT_LT(path_distance(whole, parts), 1e-12);
}

/// What is left behind when the other path turns back within less than a sample.
TEST(PathDistance, FollowsACurveAroundAHairpinAndPastItsStart) {
  RationalBezier rest = cubic({0.0, 0.0}, {-0.18, 0.0111}, {0.26, -0.0435}, {0.53, -0.08});
  const Pieces whole = {rest, LinePiece{{0.53, -0.08}, {2.0, -0.3}}};
  Pieces parts;
  for (int i = 0; i < 40; ++i) {
    const auto [first, second] = split(rest, 0.05);
    parts.emplace_back(first);
    rest = second;
  }
  parts.emplace_back(rest);
  parts.push_back(whole.back());
  EXPECT_LT(path_distance(whole, parts), 1e-12);
}

TEST(PathDistance, OfClosedPathsFarAwayGoesOnFromTheirStartsWhereTheEndIsAsNear) {
  // a long way round in three lines, and the same way in short ones that end an ulp nearer to the
  // seam than they begin
  const Vec2 from{-6e7, 4e5}, right{-5.9e7, 4e5}, top{-5.9e7, 9e5};
  const std::vector<Vec2> corners{from, right, top, from};
  std::vector<Piece> few, many;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    few.emplace_back(LinePiece{corners[i], corners[i + 1]});
    constexpr int kParts = 80;
    for (int k = 0; k < kParts; ++k) {
      const auto at = [&](int part) {
        return corners[i] + (static_cast<double>(part) / kParts) * (corners[i + 1] - corners[i]);
      };
      many.emplace_back(LinePiece{at(k), k + 1 == kParts ? corners[i + 1] : at(k + 1)});
    }
  }
  std::get<LinePiece>(many.front()).start.x = std::nextafter(from.x, 0.0);
  EXPECT_LT(path_distance(few, many), 1e-7);
  EXPECT_LT(path_distance(many, few), 1e-7);
}

TEST(PathDistance, OfClosedPathsWhoseSeamsLieBesideEachOtherIsThatBetweenThem) {
  // the seam of the one is nearest to the last piece of the other, places behind it to the first
  Pieces quarters, many;
  for (int k = 0; k < 4; ++k) {
    quarters.push_back(arc_around({0.0, 0.0}, 1.0, 0.5 * kPi * k, 0.5 * kPi));
  }
  for (int k = 0; k < 128; ++k) {
    many.push_back(arc_around({0.0, 0.0}, 1.01, 0.01 + 2.0 * kPi * k / 128, 2.0 * kPi / 128));
  }
  // beside a seam a place may be taken for the nearest that is up to 1 % farther
  for (const double bound : {path_distance(quarters, many), path_distance(many, quarters)}) {
    EXPECT_GE(bound, 0.01 * (1.0 - 1e-12));
    EXPECT_LE(bound, 1.01 * 0.01);
  }
}

TEST(PathDistance, SurvivesPiecesOfNoLengthAndEmptyPaths) {
  const Pieces point = {LinePiece{{0.0, 0.0}, {0.0, 0.0}}};
  EXPECT_NEAR(path_distance(point, Pieces{LinePiece{{0.0, 0.0}, {3.0, 4.0}}}), 5.0, 1e-12);
  EXPECT_EQ(path_distance({}, point), 0.0);
}

}  // namespace
}  // namespace obvid
