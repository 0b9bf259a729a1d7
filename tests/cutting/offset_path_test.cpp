// SPDX-License-Identifier: Apache-2.0
// Parallels of squares and circles, by their closed forms.
#include "offset_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace obvid::cutting {
namespace {

constexpr double kSide = 40.0, kRadius = 10.0;
constexpr double kHalfTurn = std::numbers::pi;
constexpr double kCloseBy = 1e-11;  // of lengths and areas: rounding

/// Counterclockwise.
ArcPath square() {
  const Vec2 at[] = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
  ArcPath out;
  out.closed = true;
  for (std::size_t i = 0; i < 4; ++i) out.pieces.emplace_back(LinePiece{at[i], at[(i + 1) % 4]});
  return out;
}

/// Two half circles, counterclockwise.
ArcPath circle() {
  const Vec2 right{kRadius, 0}, left{-kRadius, 0};
  ArcPath out;
  out.closed = true;
  out.pieces.emplace_back(
      ArcPiece{right, left, 0.5 * kHalfTurn, 1.0 / kRadius, kHalfTurn * kRadius});
  out.pieces.emplace_back(
      ArcPiece{left, right, 1.5 * kHalfTurn, 1.0 / kRadius, kHalfTurn * kRadius});
  return out;
}

TEST(ParallelOfASquare, InsideIsASmallerSquareThatKeepsItsCorners) {
  constexpr double kBy = 3.0, kInner = kSide - 2.0 * kBy;
  const auto made = parallel_of(square(), kBy);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_NEAR(area_of(made->path), kInner * kInner, kCloseBy * kSide * kSide);
  EXPECT_NEAR(length_of(made->path), 4.0 * kInner, kCloseBy * kSide);
  ASSERT_EQ(made->corners.size(), 4U);
  for (const Parallel::InnerCorner& corner : made->corners) {
    EXPECT_NEAR(corner.reach, kBy, kCloseBy * kSide);
    EXPECT_NEAR(corner.left, (std::numbers::sqrt2 - 1.0) * kBy, kCloseBy * kSide);
  }
}

/// A line down, a tiny one across, a line to the right: the tool touches the long ones alone, and
/// is hypot(r, r - e) - r from the ends of the tiny one.
// A chamfer so short that the tool does not come to it: it stands where it touches both long lines.
TEST(ParallelOfACorner, WhatIsLeftAtAShortLineIsMeasured) {
  constexpr double kBy = 3.0;
  for (const double share : {1e-3, 0.2, 0.42, 0.45, 0.6, 0.8}) {  // of its length
    SCOPED_TRACE(share);
    const double c = share * kBy / std::numbers::sqrt2;
    const Vec2 at[] = {{0, kSide}, {0, c}, {c, 0}, {kSide, 0}};
    ArcPath corner;
    for (std::size_t i = 0; i < 3; ++i) corner.pieces.emplace_back(LinePiece{at[i], at[i + 1]});
    const auto made = parallel_of(corner, kBy);
    ASSERT_TRUE(made) << to_line(made.error());
    ASSERT_EQ(made->corners.size(), 2U);
    for (const Parallel::InnerCorner& one : made->corners) {
      EXPECT_NEAR(one.left, std::hypot(kBy, kBy - c) - kBy, kCloseBy * kSide);
      // it touches (0, kBy) and (kBy, 0)
      EXPECT_NEAR(one.reach, std::max(kBy - c, std::hypot(kBy, c)), kCloseBy * kSide);
    }
  }
}

// A notch beside a thin wall: of both legs' walls (two lines from the notch, half an angle h
// between them) the tool stays r / sin(h) from its ground; its way along the plate's other side is
// nearer.
TEST(ParallelOfACorner, WhatIsLeftIsNotMeasuredThroughAThinWall) {
  constexpr double kBy = 3.0;
  const Vec2 at[] = {{0, 0}, {40, 0}, {40, 30}, {25, 30}, {20, 2}, {15, 30}, {0, 30}};
  ArcPath plate;
  plate.closed = true;
  for (std::size_t i = 0; i < 7; ++i) plate.pieces.emplace_back(LinePiece{at[i], at[(i + 1) % 7]});
  const auto made = parallel_of(plate, -kBy);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->corners.size(), 1U);
  const double half = std::atan2(5.0, 28.0);
  EXPECT_NEAR(made->corners[0].left, kBy * (1.0 / std::sin(half) - 1.0), kCloseBy * kSide);
  EXPECT_NEAR(made->corners[0].reach, kBy / std::tan(half), kCloseBy * kSide);
}

/// A plate of 40 by 20 whose upper side has something in its middle; the tool of radius 2 is
/// outside.
Result<Parallel> around_plate(const std::vector<Vec2>& inside) {
  std::vector<Vec2> at = {{0, 0}, {40, 0}, {40, 20}};
  at.insert(at.end(), inside.begin(), inside.end());
  ArcPath plate;
  plate.closed = true;
  for (std::size_t i = 0; i < at.size(); ++i)
    plate.pieces.emplace_back(LinePiece{at[i], at[(i + 1) % at.size()]});
  return parallel_of(plate, -2.0);
}

// It hangs in the mouth: its centre is sqrt(r^2 - (w/2)^2) above both corners of that.
TEST(ParallelOfASlot, WhatTheToolDoesNotEnterIsTold) {
  const struct {
    const char* name;
    std::vector<Vec2> inside;
    double length, half_mouth, below,
        aside;  // of the inner corner: below the mouth, off its middle
  } cases[] = {
      {"slot", {{20.5, 20}, {20.5, 10}, {19.5, 10}, {19.5, 20}}, 21.0, 0.5, 10.0, 0.5},
      {"shallow slot", {{20.5, 20}, {20.5, 19.7}, {19.5, 19.7}, {19.5, 20}}, 1.6, 0.5, 0.3, 0.5},
      {"a little narrower", {{21.9, 20}, {21.9, 16}, {18.1, 16}, {18.1, 20}}, 11.8, 1.9, 4.0, 1.9},
      {"half as wide as it, where its walls meet the ends of its ground",
       {{21, 20}, {21, 10}, {19, 10}, {19, 20}},
       22.0,
       1.0,
       10.0,
       1.0},
      {"notch", {{20.5, 20}, {20, 5}, {19.5, 20}}, 2.0 * std::hypot(0.5, 15.0), 0.5, 15.0, 0.0},
  };
  for (const auto& one : cases) {
    SCOPED_TRACE(one.name);
    std::vector<Vec2> inside = one.inside;
    inside.push_back({0, 20});
    const auto made = around_plate(inside);
    ASSERT_TRUE(made) << to_line(made.error());
    ASSERT_EQ(made->untouched.size(), 1U);
    const Parallel::Untouched& found = made->untouched[0];
    EXPECT_TRUE(found.slot);
    EXPECT_NEAR(found.length, one.length, kCloseBy * kSide);
    const double above = std::sqrt(4.0 - one.half_mouth * one.half_mouth);
    EXPECT_NEAR(found.left, std::hypot(one.aside, above + one.below) - 2.0, kCloseBy * kSide);
  }
}

// Beside a wall that goes on upwards.
TEST(ParallelOfASlot, BesideAWallIsOneToo) {
  const auto made = around_plate({{20, 20}, {20, 10}, {19, 10}, {19, 40}, {0, 40}});
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->untouched.size(), 1U);
  EXPECT_TRUE(made->untouched[0].slot);
  EXPECT_NEAR(made->untouched[0].length, 11.0, kCloseBy * kSide);
  // it lies on the upper side and the wall
  EXPECT_NEAR(made->untouched[0].left, std::hypot(2.0, 12.0) - 2.0, kCloseBy * kSide);
}

TEST(ParallelOfASlot, WideOnesAndCornersThatItTouchesAreNone) {
  for (const std::vector<Vec2>& inside : {
           std::vector<Vec2>{{22.1, 20}, {22.1, 16}, {17.9, 16}, {17.9, 20}, {0, 20}},  // slot
           std::vector<Vec2>{
               {24, 20}, {20, 5}, {16, 20}, {0, 20}},       // notch: r / tan(w/2) of a wall is left
           std::vector<Vec2>{{20, 20}, {20, 12}, {0, 12}},  // a step higher than the radius
       }) {
    const auto made = around_plate(inside);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_TRUE(made->untouched.empty());
  }
}

// A step of 1: the tool lies on the ground and on the upper corner, sqrt(r^2 - (r - 1)^2) off the
// wall. A chamfer of 0.5 by 0.5 in a corner of lines that are long.
TEST(ParallelOfACorner, StepsAndChamfersThatItDoesNotTouchAreNoSlots) {
  for (const double rise : {-1.0, 1.0}) {
    const auto step = around_plate({{20, 20}, {20, 20 + rise}, {0, 20 + rise}});
    ASSERT_TRUE(step);
    ASSERT_EQ(step->untouched.size(), 1U);
    EXPECT_FALSE(step->untouched[0].slot);
    EXPECT_NEAR(step->untouched[0].length, 1.0, kCloseBy * kSide);
    EXPECT_NEAR(step->untouched[0].left, std::hypot(std::sqrt(3.0), 2.0) - 2.0, kCloseBy * kSide);
  }
  const auto chamfer = around_plate({{20.5, 20}, {20, 20.5}, {20, 40}, {0, 40}});
  ASSERT_TRUE(chamfer);
  ASSERT_EQ(chamfer->untouched.size(), 1U);
  EXPECT_FALSE(chamfer->untouched[0].slot);
  EXPECT_NEAR(chamfer->untouched[0].left, std::hypot(2.0, 1.5) - 2.0, kCloseBy * kSide);
}

TEST(ParallelOfASquare, OutsideIsRoundedByQuarterCircles) {
  constexpr double kBy = 3.0;
  const auto made = parallel_of(square(), -kBy);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_NEAR(area_of(made->path), kSide * kSide + 4.0 * kSide * kBy + kHalfTurn * kBy * kBy,
              kCloseBy * kSide * kSide);
  EXPECT_NEAR(length_of(made->path), 4.0 * kSide + 2.0 * kHalfTurn * kBy, kCloseBy * kSide);
  EXPECT_TRUE(made->corners.empty());
  for (const Piece& piece : made->path.pieces) {
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      EXPECT_NEAR(arc->kappa, 1.0 / kBy, kCloseBy);
    }
  }
}

TEST(ParallelOfASquare, RunsTheOtherWayWhereTheSquareDoes) {
  const auto inside = parallel_of(reversed(square()), -3.0), outside = parallel_of(square(), -3.0);
  ASSERT_TRUE(inside && outside);
  EXPECT_NEAR(area_of(inside->path), -34.0 * 34.0, kCloseBy * kSide * kSide);
  EXPECT_NEAR(area_of(reversed(outside->path)), -area_of(outside->path), kCloseBy * kSide * kSide);
}

TEST(ParallelOfACircle, HasTheOtherRadius) {
  for (const double by : {4.0, -4.0, 9.0}) {
    const auto made = parallel_of(circle(), by);
    ASSERT_TRUE(made) << by;
    const double r = kRadius - by;
    EXPECT_NEAR(area_of(made->path), kHalfTurn * r * r, kCloseBy * kSide * kSide) << by;
    EXPECT_NEAR(length_of(made->path), 2.0 * kHalfTurn * r, kCloseBy * kSide) << by;
    for (const Piece& piece : made->path.pieces) {
      EXPECT_NEAR(curvature_of(piece), 1.0 / r, kCloseBy) << by;
    }
  }
}

TEST(ParallelOfACircle, IsRefusedWhereTheToolDoesNotFit) {
  const auto refused = parallel_of(circle(), 1.05 * kRadius);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kToolTooLarge);
  EXPECT_NEAR(refused.error().value, kRadius, kCloseBy * kRadius);
}

TEST(PathsOfLinesAndArcs, PartsAndBeginningsKeepLengthAndArea) {
  const ArcPath round = circle();
  const Piece part = part_of(round.pieces[0], 0.25, 0.75);
  EXPECT_NEAR(length_of(part), 0.5 * kHalfTurn * kRadius, kCloseBy);
  EXPECT_NEAR(
      norm(start_point(part) - kRadius * Vec2{std::numbers::sqrt2, std::numbers::sqrt2} / 2), 0.0,
      kCloseBy * kRadius);
  const ArcPath begun = begun_at(round, 0, 0.3);
  EXPECT_NEAR(length_of(begun), length_of(round), kCloseBy * kSide);
  EXPECT_NEAR(area_of(begun), kHalfTurn * kRadius * kRadius, kCloseBy * kSide * kSide);
  EXPECT_NEAR(norm(start_point(begun.pieces.front()) -
                   kRadius * Vec2{std::cos(0.3 * kHalfTurn), std::sin(0.3 * kHalfTurn)}),
              0.0, kCloseBy * kRadius);
}

TEST(PathsOfLinesAndArcs, DistancesBoxesAndMeetings) {
  const Piece upper = circle().pieces[0];
  EXPECT_NEAR(distance_from(upper, {0, 3}), 7.0, kCloseBy);
  EXPECT_NEAR(distance_from(upper, {0, 14}), 4.0, kCloseBy);
  EXPECT_NEAR(distance_from(upper, {kRadius + 3, -4}), 5.0, kCloseBy);  // from its end
  const Box2 box = box_of(upper);
  EXPECT_TRUE(box.low.x <= -kRadius && box.low.y <= 0.0);
  EXPECT_TRUE(box.high.x >= kRadius && box.high.y >= kRadius);
  const Piece rising = LinePiece{{0, 0}, {0, 2 * kRadius}};
  const auto meeting = meeting_of(rising, upper);
  ASSERT_TRUE(meeting);
  EXPECT_NEAR(meeting->on_first, 0.5, kCloseBy);
  EXPECT_NEAR(meeting->on_second, 0.5, kCloseBy);
  EXPECT_FALSE(meeting_of(LinePiece{{0, 0}, {0, 0.9 * kRadius}}, upper));
}

}  // namespace
}  // namespace obvid::cutting
