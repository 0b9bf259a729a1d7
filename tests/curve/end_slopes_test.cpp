// SPDX-License-Identifier: Apache-2.0
// Slopes of curvature at the ends of stored pieces, and weights that make up for the rounding of
// control points.
#include "obvid/curve/internal/end_slopes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "obvid/curve/internal/end_curvatures.h"

namespace obvid {
namespace {

/// A quartic that turns by `turn`: a parabola, which hardly changes its curvature when it turns by
/// little, and some growth.
RationalBezier flat_quartic(double turn, double growth) {
  RationalBezier out;
  out.degree = 4;
  constexpr double kRise[] = {0.0, 1.0, 4.0 / 3.0, 1.0, 0.0};
  for (std::size_t j = 0; j < 5; ++j) {
    const double x = static_cast<double>(j) / 4.0;
    out.offset[j] = {x, 0.25 * turn * kRise[j] * (1.0 + growth * x)};
    out.weight[j] = 1.0;
  }
  return out;
}

TEST(EndCurvatures, OfANearlyStraightPieceKeepTheDigitsThatItsJetLoses) {
  RationalBezier piece;
  piece.degree = 4;
  const std::array<Vec2, 5> offsets = {{{0.0, 0.0},
                                        {-6.785865843862946, 3.0621529006305988},
                                        {-6.858570176569697, 3.0949610646575487},
                                        {-13.644376630798591, 6.157028996081226},
                                        {-13.716999999999999, 6.189799999999998}}};
  const std::array<double, 5> weights = {1.0, 0.002459198659400196, 0.33333736510324796,
                                         0.002459198677577104, 1.0};
  std::copy(offsets.begin(), offsets.end(), piece.offset.begin());
  std::copy(weights.begin(), weights.end(), piece.weight.begin());
  // 3/4 w0 w2 / w1^2 times the area of the legs over the first one's cube, in rational numbers
  constexpr double kStart = -1.6414240508003943e-06, kEnd = 4.779600094892164e-07;
  EXPECT_NEAR(accurate_curvature(piece, 0.0) / kStart, 1.0, 1e-14);
  EXPECT_NEAR(accurate_curvature(piece, 1.0) / kEnd, 1.0, 1e-14);
  const double of_jet = curvature(evaluate(Piece{piece}, 1.0));
  EXPECT_GT(std::abs(of_jet / kEnd - 1.0), 1e-6) << "no test of what it is for";
}

TEST(EndCurvatures, InsideOfANearlyStraightPieceKeepTheirDigitsToo) {
  RationalBezier piece;
  piece.degree = 5;
  const std::array<Vec2, 6> points = {{{-3033983.384364171, 1292654.4990971878},
                                       {-3034020.60075603, 1292675.724350767},
                                       {-3034057.817070317, 1292696.9497403603},
                                       {-3034095.033307026, 1292718.1752659644},
                                       {-3034132.249466168, 1292739.400927585},
                                       {-3034169.4655477367, 1292760.6267252187}}};
  std::copy(points.begin(), points.end(), piece.offset.begin());
  piece.weight.fill(1.0);
  constexpr double kEarly = 0.18685419099226333;
  // in 50 digits, from the derivatives of the polynomials
  constexpr double kFirst = -6.8242460944823275666e-8, kThen = -6.8242370613092422375e-8;
  EXPECT_NEAR(accurate_curvature(piece, kEarly) / kFirst, 1.0, 1e-15);
  EXPECT_NEAR(accurate_curvature(piece, 0.7) / kThen, 1.0, 1e-15);
  // beside its ends it is what it is there
  for (const double beside : {0x1p-50, 1e-9}) {
    EXPECT_NEAR(accurate_curvature(piece, 1.0 - beside) / stored_curvature(piece, false), 1.0,
                1e-5 * beside + 1e-15);
    EXPECT_NEAR(accurate_curvature(piece, beside) / stored_curvature(piece, true), 1.0,
                1e-5 * beside + 1e-15);
  }
  const double of_jet = curvature(evaluate(Piece{piece}, kEarly));
  EXPECT_GT(std::abs(of_jet / kFirst - 1.0), 1e-10) << "no test of what it is for";
  // the quarter of a circle: weights count
  RationalBezier quarter{{}, 2, {Vec2{2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}}, {1.0, 1.0, 2.0}};
  for (const double t : {0.1, 0.5, 0.9}) {
    Jet flat = evaluate(Piece{quarter}, t);
    flat.d2 = {};  // a jet that knows nothing
    EXPECT_NEAR(accurate_curvature(quarter, t, flat), 0.5, 2e-16);
  }
}

TEST(EndSlopes, AreTheDerivativeOfTheCurvature) {
  for (const double turn : {0.9, 0.1, 1e-3}) {
    const RationalBezier piece = flat_quartic(turn, 0.2);
    const double start = curvature_rate(evaluate(Piece{piece}, 0.0));
    const double end = curvature_rate(evaluate(Piece{piece}, 1.0));
    EXPECT_NEAR(stored_slope(piece, true), start, 1e-10 * turn);
    EXPECT_NEAR(stored_slope(piece, false), end, 1e-10 * turn);
  }
}

TEST(EndSlopes, AreKeptWhereRoundingOfPointsMovedThem) {
  const RationalBezier meant = flat_quartic(1e-4, 1e-6);
  const WantedSlopes wanted{stored_slope(meant, true), stored_slope(meant, false)};
  RationalBezier rounded = meant;
  constexpr double kLastBits = 3e-16;  // what four operations on coordinates of this size leave
  rounded.offset[1].y += kLastBits;
  rounded.offset[2].y -= kLastBits;
  rounded.offset[3].y -= kLastBits;
  const double unit = std::max(std::abs(wanted.start), std::abs(wanted.end));
  EXPECT_GT(std::abs(stored_slope(rounded, true) - wanted.start), 1e-7 * unit);
  keep_end_slopes(rounded, wanted);
  EXPECT_NEAR(stored_slope(rounded, true), wanted.start, 1e-8 * unit);
  EXPECT_NEAR(stored_slope(rounded, false), wanted.end, 1e-8 * unit);
  for (std::size_t j = 0; j < 5; ++j) {
    EXPECT_NEAR(rounded.weight[j], meant.weight[j], 1e-9);
    EXPECT_EQ(rounded.weight[j] == meant.weight[j], j == 0 || j == 4) << j;
  }
}

TEST(EndSlopes, OfAnotherCurveAreNotForcedUponIt) {
  const RationalBezier before = flat_quartic(1e-2, 0.3);
  RationalBezier piece = before;
  keep_end_slopes(piece, {1.01 * stored_slope(piece, true), stored_slope(piece, false)});
  for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(piece.weight[j], before.weight[j]);
}

}  // namespace
}  // namespace obvid
