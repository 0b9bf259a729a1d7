// SPDX-License-Identifier: Apache-2.0
// Proofs of clothoid pieces: verdicts, half turns, ends by quadrature, and crossings between runs
// against a polyline.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "end_data.h"
#include "obvid/certify/certify.h"
#include "obvid/certify/internal/crossings.h"
#include "obvid/curve/internal/clothoid.h"
#include "piece_facts.h"

namespace obvid {
namespace {

ClothoidPiece from(const Element& start, double kappa1, double length) {
  const Vec2 end = start.point + clothoid_step(start.theta, start.kappa, kappa1, length);
  return {start.point, end, start.theta, start.kappa, kappa1, length};
}

Verdict clothoid_verdict(const ClothoidPiece& piece) { return prove_piece(piece).verdict; }

TEST(ProveClothoid, ItsEndsDecideHoweverCloseTheirCurvaturesAre) {
  const Element start = {{0, 0}, 0.3, 0.5};
  EXPECT_EQ(clothoid_verdict(from(start, 0.9, 1.0)), Verdict::kIncreasing);
  EXPECT_EQ(clothoid_verdict(from(start, -0.9, 1.0)), Verdict::kDecreasing);
  EXPECT_EQ(clothoid_verdict(from(start, 0.5, 1.0)), Verdict::kConstant);
  EXPECT_EQ(clothoid_verdict(from(start, std::nextafter(0.5, 1.0), 1.0)), Verdict::kIncreasing);
  EXPECT_EQ(clothoid_verdict(from(start, std::nextafter(0.5, 0.0), 1.0)), Verdict::kDecreasing);
}

TEST(ProveClothoid, WithoutLengthOrFiniteNumbersItIsNotProved) {
  const ClothoidPiece good = from({{0, 0}, 0.3, 0.5}, 0.9, 1.0);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  ClothoidPiece bad = good;
  bad.length = 0.0;
  EXPECT_EQ(clothoid_verdict(bad), Verdict::kUndecided);
  bad.length = -1.0;
  EXPECT_EQ(clothoid_verdict(bad), Verdict::kUndecided);
  for (double ClothoidPiece::*field : {&ClothoidPiece::theta0, &ClothoidPiece::kappa0,
                                       &ClothoidPiece::kappa1, &ClothoidPiece::length}) {
    for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
      bad = good;
      bad.*field = value;
      EXPECT_EQ(clothoid_verdict(bad), Verdict::kUndecided);
    }
  }
}

TEST(ProveClothoid, HalfATurnIsTooMuchForOnePiece) {
  const auto below = [](double k0, double k1, double length) {
    return examine_piece(from({{0, 0}, 0.0, k0}, k1, length)).turns_below_pi;
  };
  EXPECT_TRUE(below(0.0, 2.0, 3.14));  // turns by 3.14
  EXPECT_FALSE(below(0.0, 2.0, 3.15));
  EXPECT_FALSE(below(-2.0, 0.0, 3.15));
  // two lobes that undo each other: each turns by kappa L/4
  EXPECT_TRUE(below(-2.0, 2.0, 3.1));
  EXPECT_FALSE(below(-2.0, 2.0, 6.4));
}

TEST(ProveClothoid, EndIsWhereTheNumbersLeadNotWhereItIsStored) {
  ClothoidPiece piece = from({{3, -2}, 0.3, -0.5}, 2.9, 1.7);
  const Vec2 truth = piece.end;
  piece.end = {9.0, 9.0};
  const EndData end = ends_of(piece).end;
  EXPECT_NEAR(norm(end.point - truth), 0.0, 1e-14);
  EXPECT_NEAR(norm(end.direction - unit_at(0.3 + 0.5 * 2.4 * 1.7)), 0.0, 1e-14);
  EXPECT_EQ(end.kappa, 2.9);
  EXPECT_EQ(ends_of(piece).start.kappa, -0.5);
}

/// Crossings of a polyline with itself, neighbours apart.
int crossings_of(const std::vector<Vec2>& p) {
  int count = 0;
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j) {
      const auto side = [](Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a) > 0.0; };
      count += side(p[i], p[i + 1], p[j]) != side(p[i], p[i + 1], p[j + 1]) &&
                       side(p[j], p[j + 1], p[i]) != side(p[j], p[j + 1], p[i + 1])
                   ? 1
                   : 0;
    }
  }
  return count;
}

TEST(ProveClothoid, LoopsOfTwoRunsCrossAsOftenAsTheirPolyline) {
  bool seen[2] = {false, false};
  for (const double length : {0.8, 1.2, 1.6, 1.9, 2.05}) {
    const ClothoidPiece rising = from({{0, 0}, 0.0, 0.0}, 3.0, length);
    const Element top = {rising.end, 1.5 * length, 3.0};
    const ClothoidPiece falling = from(top, 0.0, length);
    Contour contour;
    contour.carrier = Carrier::kClothoids;
    contour.pieces = {rising, falling};
    contour.runs = {{0, 0, 1}, {1, 1, -1}};
    constexpr int kSteps = 300;
    std::vector<Vec2> polyline;
    for (const Piece& piece : contour.pieces) {
      for (int j = 0; j < kSteps; ++j) polyline.push_back(evaluate(piece, 1.0 * j / kSteps).point);
    }
    const int expected = crossings_of(polyline);
    EXPECT_EQ(count_crossings(contour), expected) << length;
    seen[expected > 0 ? 1 : 0] = true;
  }
  EXPECT_TRUE(seen[0] && seen[1]) << "both kinds of loop are tried";
}

}  // namespace
}  // namespace obvid
