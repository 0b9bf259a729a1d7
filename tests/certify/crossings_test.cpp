// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/internal/crossings.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

Contour each_its_own_run(std::vector<Piece> pieces) {
  Contour contour;
  contour.pieces = std::move(pieces);
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) contour.runs.push_back({i, i, 0});
  return contour;
}

TEST(CountCrossings, LinesThatCrossOnce) {
  EXPECT_EQ(count_crossings(each_its_own_run(
                {LinePiece{{0, 0}, {1, 1}}, LinePiece{{1, 1}, {1, 0}}, LinePiece{{1, 0}, {0, 1}}})),
            1);
}

TEST(CountCrossings, PiecesOfOneRunAreNotCompared) {
  Contour contour = each_its_own_run(
      {LinePiece{{0, 0}, {1, 1}}, LinePiece{{1, 1}, {1, 0}}, LinePiece{{1, 0}, {0, 1}}});
  contour.runs = {{0, 2, 0}};
  EXPECT_EQ(count_crossings(contour), 0);
}

TEST(CountCrossings, PiecesOfOneRunThatIsNotMonotoneAreCompared) {
  Contour contour = each_its_own_run(
      {LinePiece{{0, 0}, {1, 1}}, LinePiece{{1, 1}, {1, 0}}, LinePiece{{1, 0}, {0, 1}}});
  contour.runs = {{0, 2, 0}};
  EXPECT_EQ(count_crossings(contour, std::vector<std::size_t>{1}), 1);
}

TEST(CountCrossings, APieceThatIsNotMonotoneMayMeetItself) {
  // y(t) = y(1 - t), and x(t) - x(1 - t) has one zero beside t = 1/2 there: a loop
  const RationalBezier loop{{}, 3, {Vec2{0, 0}, {3, 2}, {-2, 2}, {1, 0}}, {1, 1, 1, 1}};
  const Contour one = each_its_own_run({loop});
  EXPECT_EQ(count_crossings(one, std::vector<std::size_t>{0}), 1);
  const RationalBezier plain{{}, 3, {Vec2{0, 0}, {0.2, 2}, {0.8, 2}, {1, 0}}, {1, 1, 1, 1}};
  EXPECT_EQ(count_crossings(each_its_own_run({plain}), std::vector<std::size_t>{0}), 0);
}

TEST(CountCrossings, CrossingsFarFromTheOriginAreFound) {
  // digits of the coordinates end at 1e-7 of the size
  const Vec2 far{0x1p23, 0x1p23};
  const auto cubic = [&](Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    return RationalBezier{{}, 3, {far + a, far + b, far + c, far + d}, {1, 1, 1, 1}};
  };
  constexpr double k = 0x1p-13;
  EXPECT_EQ(
      count_crossings(each_its_own_run({cubic({0, 0}, {k, 2 * k}, {2 * k, 3 * k}, {3 * k, 3 * k}),
                                        LinePiece{far + Vec2{3 * k, 3 * k}, far + Vec2{3 * k, 0}},
                                        cubic({3 * k, 0}, {2 * k, 0}, {k, k}, {0, 3 * k})})),
      1);
}

TEST(CountCrossings, SharedJointIsNoCrossing) {
  EXPECT_EQ(
      count_crossings(each_its_own_run({LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {2, 1}}})), 0);
  // A sharp turn back: both legs leave the joint side by side.
  EXPECT_EQ(
      count_crossings(each_its_own_run({LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {0, 0.1}}})),
      0);
}

TEST(CountCrossings, ReturningToTheStartPointIsNoCrossing) {
  // Thin foil with a closed trailing edge.
  const RationalBezier upper{{}, 3, {Vec2{1, 0}, {0.5, 0.2}, {0, 0.1}, {0, 0}}, {1, 1, 1, 1}};
  const RationalBezier lower{{}, 3, {Vec2{0, 0}, {0, -0.1}, {0.5, -0.1}, {1, 0}}, {1, 1, 1, 1}};
  EXPECT_EQ(count_crossings(each_its_own_run({upper, lower})), 0);
}

TEST(CountCrossings, FigureEightOfArcsCrossesOnce) {
  // Two circles' arcs around (-1, 0) and (1, 0) with radius 1.25 cut each other at x = 0 twice;
  // the left one spans the upper crossing only.
  const double phi = std::acos(0.8);  // both meet at angle phi seen from their centres
  const ArcPiece left{{0.25, 0}, {-1, 1.25}, kPi / 2, 0.8, 1.25 * kPi / 2};
  const ArcPiece right{{1, 1.25}, {-0.25, 0}, kPi, 0.8, 1.25 * kPi / 2};
  ASSERT_LT(phi, kPi / 2);
  EXPECT_EQ(count_crossings(each_its_own_run(
                {left, LinePiece{{-1, 1.25}, {-1, 3}}, LinePiece{{-1, 3}, {1, 1.25}}, right})),
            1);
}

TEST(CountCrossings, WaveOverALineCrossesAtEachRoot) {
  // y = (x - 1/8)(x - 1/2)(x - 7/8), x = t; reached from below, where nothing else crosses.
  const double y0 = -7.0 / 128.0;
  const double slope = 1.0 / 16 + 7.0 / 64 + 7.0 / 16;  // sum of products of roots in pairs
  const double y1 = y0 + slope / 3.0;
  const RationalBezier wave{
      {}, 3, {Vec2{0, y0}, {1.0 / 3, y1}, {2.0 / 3, -y1}, {1, -y0}}, {1, 1, 1, 1}};
  EXPECT_EQ(
      count_crossings(each_its_own_run({LinePiece{{-1, 0}, {2, 0}}, LinePiece{{2, 0}, {2, -5}},
                                        LinePiece{{2, -5}, {0, y0}}, wave})),
      3);
}

TEST(CountCrossings, ManySeparateRunsCostLittle) {
  std::vector<Piece> pieces;
  for (int i = 0; i < 100000; ++i) {
    pieces.emplace_back(
        LinePiece{{double(i), double(i % 2)}, {double(i + 1), double((i + 1) % 2)}});
  }
  EXPECT_EQ(count_crossings(each_its_own_run(std::move(pieces))), 0);
}

}  // namespace
}  // namespace obvid
