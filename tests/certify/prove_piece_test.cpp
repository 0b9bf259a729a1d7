// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "obvid/certify/certify.h"
#include "piece_facts.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::kHiddenVertex;
using testing_data::kSpirals;
using testing_data::spiral;
using testing_data::SpiralRow;

RationalBezier conic(Vec2 p0, Vec2 p1, Vec2 p2, double w0, double w1, double w2) {
  return {{}, 2, {p0, p1, p2}, {w0, w1, w2}};
}

// A mirror image turns increasing into decreasing. The reversed curve keeps the word: its signed
// curvature changes sign and is run through backwards.
RationalBezier mirrored(RationalBezier piece) {
  for (Vec2& q : piece.offset) q.y = -q.y;
  return piece;
}

RationalBezier reversed(RationalBezier piece) {
  const auto count = static_cast<std::ptrdiff_t>(piece.degree) + 1;
  std::reverse(piece.offset.begin(), piece.offset.begin() + count);
  std::reverse(piece.weight.begin(), piece.weight.begin() + count);
  return piece;
}

Verdict verdict(const Piece& piece) { return prove_piece(piece).verdict; }

TEST(ProvePiece, LinesAndArcsAreConstant) {
  EXPECT_EQ(verdict(LinePiece{{0, 0}, {1, 2}}), Verdict::kConstant);
  EXPECT_EQ(verdict(ArcPiece{{0, 0}, {1, 1}, 0.0, 1.0, std::acos(0.0)}), Verdict::kConstant);
}

TEST(ProvePiece, DegeneratePiecesAreNotProved) {
  EXPECT_EQ(verdict(LinePiece{{1, 2}, {1, 2}}), Verdict::kUndecided);
  EXPECT_EQ(verdict(ArcPiece{{0, 0}, {1, 1}, 0.0, 1.0, -1.0}), Verdict::kUndecided);
  EXPECT_EQ(verdict(conic({1, 1}, {1, 1}, {1, 1}, 1, 1, 1)), Verdict::kUndecided);
  EXPECT_EQ(verdict(conic({0, 0}, {1, NAN}, {1, 1}, 1, 1, 1)), Verdict::kUndecided);
  EXPECT_EQ(verdict(conic({0, 0}, {1, 0}, {1, 1}, 1, INFINITY, 1)), Verdict::kUndecided);
  EXPECT_EQ(verdict(conic({0, 0}, {1, 0}, {1, 1}, 1, -3, 1)), Verdict::kUndecided) << "pole inside";
  RationalBezier no_degree;
  EXPECT_EQ(verdict(no_degree), Verdict::kUndecided);
}

TEST(ProvePiece, AVertexNarrowerThanADoubleStandsBetweenTwo) {
  // goes out and back on nearly one line: the bend is narrower than the steps of t
  const RationalBezier fold{{},
                            3,
                            {Vec2{197670.74784752462, 354792.6831125179},
                             {249052.3659154773, 447015.84890246234},
                             {-51381.618107847156, -92223.16576771751},
                             {-4.5179931449640594e-07, 2.517174469027928e-07}},
                            {1, 1, 1, 1}};
  const PieceProof proof = prove_piece(fold);
  ASSERT_EQ(proof.verdict, Verdict::kHasVertex);
  EXPECT_LT(proof.t0, proof.t1);
  EXPECT_NEAR(proof.t0, proof.t1, 0x1p-50);
}

TEST(ProvePiece, ExactCircleIsConstantByExactArithmetic) {
  const PieceProof proof = prove_piece(conic({1, 0}, {1, 1}, {0, 1}, 1, 1, 2));
  EXPECT_EQ(proof.verdict, Verdict::kConstant);
  EXPECT_TRUE(proof.exact_arithmetic);
}

TEST(ProvePiece, QuarterEllipseBetweenItsVerticesIsMonotone) {
  // From (3, 0), where curvature is greatest (a/b^2 = 3), to (0, 1): b/a^2 = 1/9.
  const RationalBezier quarter = conic({3, 0}, {3, 1}, {0, 1}, 1, 1, 2);
  EXPECT_EQ(verdict(quarter), Verdict::kDecreasing);
  EXPECT_EQ(verdict(reversed(quarter)), Verdict::kDecreasing);
  EXPECT_EQ(verdict(mirrored(quarter)), Verdict::kIncreasing);
}

TEST(ProvePiece, EllipseBeyondItsVertexHasOne) {
  // Half an ellipse has infinite middle points; take |angle| up to 60 degrees around (3, 0).
  const double s = std::sqrt(3.0) / 2.0;
  const RationalBezier piece = conic({1.5, -s}, {6, 0}, {1.5, s}, 1, 0.5, 1);
  const PieceProof proof = prove_piece(piece);
  EXPECT_EQ(proof.verdict, Verdict::kHasVertex);
  EXPECT_LE(proof.t0, 0.5);
  EXPECT_GE(proof.t1, 0.5);
}

TEST(ProvePiece, HalfEllipseOfDegreeFourHasAVertex) {
  // cos phi = (s^2 - t^2)/(s^2 + t^2), sin phi = 2 s t/(s^2 + t^2), all times (s + t)^2 = 1:
  // weights (1, 1/2, 1/3, 1/2, 1), numerators 3 (1, 1/2, 0, -1/2, -1) and (0, 1/2, 2/3, 1/2, 0).
  // Weights times 3 are exact doubles, so the vertices at both ends are exactly there.
  const RationalBezier half{
      {}, 4, {Vec2{3, 0}, {3, 1}, {0, 2}, {-3, 1}, {-3, 0}}, {3.0, 1.5, 1.0, 1.5, 3.0}};
  const PieceProof proof = prove_piece(half);
  EXPECT_EQ(proof.verdict, Verdict::kHasVertex);
  EXPECT_LE(proof.t0, 0.5);
  EXPECT_GE(proof.t1, 0.5);
}

TEST(ProvePiece, BranchOfAParabolaIsMonotoneAndAnArcOverItsVertexIsNot) {
  EXPECT_EQ(verdict(conic({0, 0}, {0.5, 0}, {1, 1}, 1, 1, 1)), Verdict::kDecreasing);
  EXPECT_EQ(verdict(conic({-1, 1}, {-0.5, 0}, {0, 0}, 1, 1, 1)), Verdict::kIncreasing);
  const PieceProof over = prove_piece(conic({-1, 1}, {0.25, -1.5}, {1.5, 2.25}, 1, 1, 1));
  EXPECT_EQ(over.verdict, Verdict::kHasVertex);  // at x = 0: t = 0.4
  EXPECT_LE(over.t0, 0.4);
  EXPECT_GE(over.t1, 0.4);
}

TEST(ProvePiece, VertexJustInsideIsFoundAndJustOutsideIsNot) {
  // y = x^2 from x = e to 1: control points (e, e^2), ((1+e)/2, e), (1, 1), all exact doubles.
  for (const int digits : {10, 20, 25}) {
    const double e = std::ldexp(1.0, -digits);
    EXPECT_EQ(verdict(conic({e, e * e}, {(1 + e) / 2, e}, {1, 1}, 1, 1, 1)), Verdict::kDecreasing);
    EXPECT_EQ(verdict(conic({-e, e * e}, {(1 - e) / 2, -e}, {1, 1}, 1, 1, 1)), Verdict::kHasVertex);
  }
}

TEST(ProvePiece, CubicThroughItsInflectionIsMonotone) {
  // y = x^3 on [-0.3, 0.3]: kappa = 6 x / (1 + 9 x^4)^(3/2) grows for 45 x^4 < 1, |x| < 0.386.
  const auto cubic = [](double a) {
    return RationalBezier{
        {},
        3,
        {Vec2{-a, -a * a * a}, {-a / 3, a * a * a}, {a / 3, -a * a * a}, {a, a * a * a}},
        {1, 1, 1, 1}};
  };
  EXPECT_EQ(verdict(cubic(0.3)), Verdict::kIncreasing);
  EXPECT_EQ(verdict(cubic(0.386)), Verdict::kIncreasing);
  EXPECT_EQ(verdict(cubic(0.387)), Verdict::kHasVertex);
}

TEST(ProvePiece, CuspIsNotProved) {
  const RationalBezier cusp{{}, 3, {Vec2{0, 0}, {1, 1}, {0, 1}, {1, 0}}, {1, 1, 1, 1}};
  const Verdict found = verdict(cusp);
  EXPECT_TRUE(found == Verdict::kUndecided || found == Verdict::kHasVertex) << to_string(found);
}

TEST(ProvePiece, ClosedFormSpiralsAreIncreasing) {
  int count = 0;
  for (const SpiralRow& row : kSpirals) {
    const RationalBezier piece = spiral(row);
    EXPECT_EQ(verdict(piece), Verdict::kIncreasing) << count;
    EXPECT_EQ(verdict(reversed(piece)), Verdict::kIncreasing) << count;
    EXPECT_EQ(verdict(mirrored(piece)), Verdict::kDecreasing) << count;
    EXPECT_EQ(verdict(mirrored(reversed(piece))), Verdict::kDecreasing) << count;
    ++count;
  }
  EXPECT_GE(count, 9);
}

TEST(ProvePiece, HiddenVertexOfTheClosedFormBeyondItsBoundIsFound) {
  EXPECT_EQ(verdict(spiral(kHiddenVertex)), Verdict::kHasVertex);
}

TEST(ProvePiece, SizeAndPlaceDoNotMatter) {
  for (const double size : {0x1p-300, 0x1p-20, 0x1p40, 0x1p300}) {
    for (const SpiralRow& row : kSpirals) {
      RationalBezier piece = spiral(row);
      for (Vec2& q : piece.offset) q = size * q;
      for (double& w : piece.weight) w *= 8.0;
      piece.origin = {1e6, -1e9};
      EXPECT_EQ(verdict(piece), Verdict::kIncreasing);
    }
  }
}

TEST(ProvePiece, QuadraticsAgreeWithTheCriterionOfSapidisAndFrey) {
  // [Sapidis, Frey 1992]: with a = P1 - P0, b = P2 - P1 monotone iff a.b >= min(|a|^2, |b|^2)...
  // for the legs; small integers make every side exact.
  std::mt19937_64 rng(11);
  std::uniform_int_distribution<int> digit(-12, 12);
  int monotone = 0, other = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec2 a{double(digit(rng)), double(digit(rng))}, b{double(digit(rng)), double(digit(rng))};
    if (cross(a, b) == 0.0) continue;
    const bool expected = dot(a, b) >= std::min(dot(a, a), dot(b, b));
    const Verdict found = verdict(conic({0, 0}, a, a + b, 1, 1, 1));
    const bool is = found == Verdict::kIncreasing || found == Verdict::kDecreasing;
    EXPECT_EQ(is, expected) << a.x << ' ' << a.y << ' ' << b.x << ' ' << b.y << ' '
                            << to_string(found);
    EXPECT_NE(found, Verdict::kUndecided);
    (expected ? monotone : other) += 1;
  }
  EXPECT_GT(monotone, 300);
  EXPECT_GT(other, 300);
}

TEST(ProvePiece, RationalQuadraticsAgreeWithTheFiveCoefficientTest) {
  // docs/methods/conics.md, 2, weights 1, w, 1: all five of one sign proves monotone |kappa|.
  std::mt19937_64 rng(12);
  std::uniform_int_distribution<int> digit(-12, 12);
  std::uniform_int_distribution<int> eighths(1, 24);
  int decided = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec2 a{double(digit(rng)), double(digit(rng))}, b{double(digit(rng)), double(digit(rng))};
    const double w = eighths(rng) / 8.0;
    const double turn = cross(a, b);
    if (turn == 0.0) continue;
    const double A = dot(a, a), B = dot(b, b), D = dot(a, b);
    const std::array<double, 5> c = {
        2 * w * (A + D - 2 * w * w * A), (A + 2 * D + B - 4 * w * w * A) / 2, w * (B - A),
        (4 * w * w * B - A - 2 * D - B) / 2, 2 * w * (2 * w * w * B - B - D)};
    const bool falls = std::all_of(c.begin(), c.end(), [](double x) { return x >= 0.0; });
    const bool rises = std::all_of(c.begin(), c.end(), [](double x) { return x <= 0.0; });
    const Verdict found = verdict(conic({0, 0}, a, a + b, 1, w, 1));
    if (falls == rises) {
      // Both only when all vanish: a circle. Opposite end signs: a vertex for sure.
      if (falls) {
        EXPECT_EQ(found, Verdict::kConstant);
      } else if (c[0] * c[4] < 0.0) {
        EXPECT_EQ(found, Verdict::kHasVertex);
      }
      continue;
    }
    ++decided;
    EXPECT_EQ(found, falls == (turn > 0.0) ? Verdict::kDecreasing : Verdict::kIncreasing);
  }
  EXPECT_GT(decided, 500);
}

TEST(ProvePiece, AllThreeArithmeticsAgreeWhereTheyDecide) {
  std::mt19937_64 rng(13);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int fast = 0, in_double_doubles = 0, total = 0;
  for (int i = 0; i < 400; ++i) {
    RationalBezier piece = spiral(kSpirals[static_cast<std::size_t>(i) % std::size(kSpirals)]);
    const double noise = std::pow(10.0, -2.0 - 13.0 * (i % 20) / 20.0);
    for (std::size_t j = 0; j <= 4; ++j) {
      piece.offset[j] = piece.offset[j] + noise * Vec2{unit(rng), unit(rng)};
    }
    const Verdict a = examine_in_doubles(piece).proof.verdict;
    const Verdict b = examine_in_double_double(piece).proof.verdict;
    const Verdict c = examine_exactly(piece).proof.verdict;
    ++total;
    fast += a != Verdict::kUndecided;
    in_double_doubles += b != Verdict::kUndecided;
    EXPECT_TRUE(a == Verdict::kUndecided || a == c) << i;
    EXPECT_TRUE(b == Verdict::kUndecided || b == c) << i;
    EXPECT_NE(c, Verdict::kUndecided) << i;
  }
  EXPECT_GT(fast, total / 2);
  EXPECT_GT(in_double_doubles, total * 9 / 10);
}

TEST(ProvePiece, FlatPiecesAreDecidedAsExactArithmeticDecidesThem) {
  // Short parts of the spirals: areas of their control triangles cancel almost entirely. Noise of
  // some ulps gives the verdict either way.
  std::mt19937_64 rng(14);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int fast = 0, monotone = 0, total = 0;
  for (int i = 0; i < 360; ++i) {
    RationalBezier piece = spiral(kSpirals[static_cast<std::size_t>(i) % std::size(kSpirals)]);
    for (int halving = 0; halving < 4 + i % 18; ++halving) {
      piece = split(piece, 0.5)[static_cast<std::size_t>(halving % 2)];
    }
    const double ulps = std::ldexp(norm(piece.offset[4] - piece.offset[0]), -50 + i % 7);
    for (std::size_t j = 0; j <= 4; ++j) {
      piece.offset[j] = piece.offset[j] + ulps * Vec2{unit(rng), unit(rng)};
    }
    const PieceProof found = prove_piece(piece);
    EXPECT_EQ(found.verdict, examine_exactly(piece).proof.verdict) << i;
    ++total;
    fast += !found.exact_arithmetic;
    monotone += found.verdict == Verdict::kIncreasing;
  }
  EXPECT_GT(fast, total / 4);
  EXPECT_GT(monotone, total / 4);
  EXPECT_LT(monotone, total);
}

TEST(ProvePiece, NearlyCircularPieceNeedsNoMoreThanDoubleDouble) {
  // A spiral so short that its curvature changes by 1e-9 of itself: theory's clothoid scaled down.
  RationalBezier piece = conic({3, 0}, {3, 1}, {0, 1}, 1, 1, 2);
  RationalBezier part = split(split(piece, 0.5)[0], 0x1p-12)[1];
  part = split(part, 0x1p-24)[0];
  const PieceProof proof = prove_piece(part);
  EXPECT_NE(proof.verdict, Verdict::kUndecided);
}

TEST(PieceFacts, TurningBelowHalfATurnIsProvedAndMoreIsNot) {
  EXPECT_TRUE(examine_piece(spiral(kSpirals[0])).turns_below_pi);
  EXPECT_TRUE(examine_piece(ArcPiece{{}, {}, 0.0, 1.0, 3.1}).turns_below_pi);
  EXPECT_FALSE(examine_piece(ArcPiece{{}, {}, 0.0, 1.0, 3.2}).turns_below_pi);
  // Half ellipse of degree 4 turns by exactly pi: the open half plane does not hold both ends.
  const RationalBezier loop{{}, 3, {Vec2{0, 0}, {3, 2}, {-2, 2}, {1, 0}}, {1, 1, 1, 1}};
  EXPECT_FALSE(examine_piece(loop).turns_below_pi);
}

std::vector<int> bends(const RationalBezier& piece) {
  std::vector<int> signs, exact;
  for (const SignFrom& one : curvature_signs(piece)) signs.push_back(one.sign);
  for (const SignFrom& one : curvature_signs_exactly(piece)) exact.push_back(one.sign);
  EXPECT_EQ(signs, exact);
  return signs;
}

TEST(CurvatureSigns, AreThoseOfKnownPolynomials) {
  using Signs = std::vector<int>;
  // y = x - x^3 over [-1, 1] bends to the left, then to the right
  const RationalBezier cubic{
      {}, 3, {Vec2{-1, 0}, {-1.0 / 3, -4.0 / 3}, {1.0 / 3, 4.0 / 3}, {1, 0}}, {1, 1, 1, 1}};
  EXPECT_EQ(bends(cubic), (Signs{1, -1}));
  EXPECT_EQ(bends(mirrored(cubic)), (Signs{-1, 1}));
  EXPECT_NEAR(curvature_signs(cubic)[1].t, 0.5, 1e-9);
  // y'' = 12 x^2 - 3 changes its sign twice: y = x^4 - 1.5 x^2 over [-1, 1]
  const RationalBezier quartic{
      {}, 4, {Vec2{-1, -0.5}, {-0.5, -1}, {0, 1.5}, {0.5, -1}, {1, -0.5}}, {1, 1, 1, 1, 1}};
  EXPECT_EQ(bends(quartic), (Signs{1, -1, 1}));
  // half a circle by a conic
  EXPECT_EQ(bends(conic({1, 0}, {1, 1}, {0, 1}, 1, std::sqrt(0.5), 1)), Signs{1});
}

TEST(CurvatureSigns, OfATinyFlatPieceWithAVertexAreExact) {
  // between two points 2.5e-9 apart: curvature -0.00253 all along, by fractions
  RationalBezier piece{{},
                       4,
                       {Vec2{0, 0},
                        {5.780985553380543e-10, 2.4127501631602144e-10},
                        {1.1510246586487956e-09, 4.803912598128141e-10},
                        {1.7193061282236038e-09, 7.175690205528199e-10},
                        {2.2824151457712105e-09, 9.525880084737537e-10}},
                       {1, 0.9741549873119714, 0.96598529487404, 0.974155004021827, 1}};
  EXPECT_EQ(verdict(piece), Verdict::kHasVertex);
  EXPECT_EQ(bends(piece), std::vector<int>{-1});
  Contour contour;
  contour.points = {start_point(piece), end_point(piece)};
  contour.pieces = {piece};
  EXPECT_EQ(certify(contour).inflections, 0);
}

}  // namespace
}  // namespace obvid
