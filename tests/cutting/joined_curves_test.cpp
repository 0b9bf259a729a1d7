// SPDX-License-Identifier: Apache-2.0
// Open curves that are put together: squares and circles in parts, by their known lengths.
#include "joined_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid::cutting {
namespace {

constexpr double kWithin = 0.01;

ArcPath line_of(Vec2 from, Vec2 to) { return {{LinePiece{from, to}}, false}; }

/// Corners in order.
ArcPath polyline(std::initializer_list<Vec2> at) {
  ArcPath out;
  for (auto p = at.begin(); p + 1 != at.end(); ++p)
    out.pieces.emplace_back(LinePiece{*p, *(p + 1)});
  return out;
}

/// From one heading to another around the origin, counterclockwise; rad.
ArcPath arc_of(double from, double to, double radius) {
  const auto at = [&](double angle) { return radius * Vec2{std::cos(angle), std::sin(angle)}; };
  return {{ArcPiece{at(from), at(to), from + 0.5 * std::numbers::pi, 1.0 / radius,
                    (to - from) * radius}},
          false};
}

TEST(JoinedCurves, FourLinesInAnyOrderAndSenseAreOneSquare) {
  const JoinedCurves made = joined_curves({line_of({0, 0}, {8, 0}), line_of({8, 8}, {8, 0}),
                                           line_of({0, 8}, {0, 0}), line_of({0, 8}, {8, 8})},
                                          kWithin);
  ASSERT_EQ(made.chains.size(), 1U);
  EXPECT_TRUE(made.chains[0].path.closed);
  EXPECT_EQ(made.chains[0].members, (std::vector<std::size_t>{0, 1, 3, 2}));
  EXPECT_DOUBLE_EQ(std::abs(area_of(made.chains[0].path)), 64.0);
  EXPECT_EQ(made.chains[0].largest_gap, 0.0);
  EXPECT_EQ(made.chains[0].moved, 0.0);
  EXPECT_FALSE(made.enclosing);
}

TEST(JoinedCurves, EndsMeetHalfWayAndThatIsHowFarTheyWereMoved) {
  const JoinedCurves made = joined_curves(
      {polyline({{0, 0}, {8, 0}, {8, 8.008}}), polyline({{8, 8}, {0, 8}, {0, 0}})}, kWithin);
  ASSERT_EQ(made.chains.size(), 1U);
  EXPECT_TRUE(made.chains[0].path.closed);
  EXPECT_NEAR(made.chains[0].largest_gap, 0.008, 1e-12);
  EXPECT_NEAR(made.chains[0].moved, 0.004, 1e-12);
  EXPECT_EQ(made.chains[0].path.pieces.size(), 4U);
}

TEST(JoinedCurves, ShortPiecesStayAndALineLeadsOverTheGap) {
  const JoinedCurves made = joined_curves(
      {polyline({{0, 0}, {8, 0}, {8, 0.02}}), polyline({{8, 0.028}, {8, 8}, {0, 0}})}, kWithin);
  ASSERT_EQ(made.chains.size(), 1U);
  EXPECT_NEAR(made.chains[0].largest_gap, 0.008, 1e-12);
  EXPECT_EQ(made.chains[0].moved, 0.0);
  EXPECT_EQ(made.chains[0].path.pieces.size(), 5U);
}

TEST(JoinedCurves, ArcsWithOtherEndsKeepTheirTurn) {
  constexpr double kHalf = std::numbers::pi, kOff = 4e-4;  // rad, a gap of 0.008 at radius 20
  const JoinedCurves made =
      joined_curves({arc_of(0.0, kHalf, 20.0), arc_of(kHalf + kOff, 2.0 * kHalf, 20.0)}, kWithin);
  ASSERT_EQ(made.chains.size(), 1U);
  const ArcPath& path = made.chains[0].path;
  EXPECT_TRUE(path.closed);
  EXPECT_NEAR(made.chains[0].moved, 20.0 * std::sin(0.5 * kOff), 1e-9);
  for (std::size_t k = 0; k < path.pieces.size(); ++k) {
    const Piece& next = path.pieces[(k + 1) % path.pieces.size()];
    EXPECT_LE(norm(evaluate(path.pieces[k], 1.0).point - evaluate(next, 0.0).point), 1e-12);
    const auto& arc = std::get<ArcPiece>(path.pieces[k]);
    EXPECT_NEAR(arc.kappa * arc.length, k == 0 ? kHalf : kHalf - kOff, 1e-12);
  }
}

TEST(JoinedCurves, WhereThreeMeetNothingIsJoinedAndWhatClosesIsFound) {
  const ArcPath edge = line_of({8, 0}, {8, 8});
  const ArcPath left = polyline({{8, 0}, {0, 0}, {0, 8}, {8, 8}});
  const ArcPath right = polyline({{8, 0}, {16, 0}, {16, 8}, {8, 8}});
  const JoinedCurves squares = joined_curves({left, edge, right}, kWithin);
  EXPECT_EQ(squares.chains.size(), 3U);
  EXPECT_TRUE(squares.enclosing);
  const JoinedCurves star = joined_curves(
      {line_of({0, 0}, {8, 0}), line_of({0, 0}, {-4, 7}), line_of({0, 0}, {-4, -7})}, kWithin);
  EXPECT_EQ(star.chains.size(), 3U);
  EXPECT_FALSE(star.enclosing) << "three strokes of a letter enclose nothing";
}

TEST(JoinedCurves, SmallGapsAreTold) {
  const JoinedCurves made = joined_curves(
      {polyline({{0, 0}, {8, 0}, {8, 8}}), polyline({{8, 8.05}, {0, 8}, {0, 0}})}, kWithin);
  ASSERT_EQ(made.chains.size(), 1U);
  EXPECT_FALSE(made.chains[0].path.closed);
  ASSERT_EQ(made.gaps.size(), 1U);
  EXPECT_EQ(made.gaps[0].one, made.gaps[0].other);
  EXPECT_NEAR(made.gaps[0].distance, 0.05, 1e-12);
}

}  // namespace
}  // namespace obvid::cutting
