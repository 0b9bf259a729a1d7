// SPDX-License-Identifier: Apache-2.0
// What a round tool leaves beside its way, by closed forms.
#include "obvid/cutting/internal/edge_of_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "offset_path.h"

namespace obvid {
namespace {

constexpr double kToolRadius = 2.0, kLegLength = 20.0;
constexpr double kPi = std::numbers::pi;

std::vector<CutMove> along(const std::vector<Vec2>& places) {
  std::vector<CutMove> out;
  for (std::size_t i = 1; i < places.size(); ++i) {
    out.push_back({CutMoveKind::kCut, LinePiece{places[i - 1], places[i]}});
  }
  return out;
}

double length_of_all(const std::vector<Piece>& pieces) {
  double out = 0.0;
  for (const Piece& piece : pieces) out += cutting::length_of(piece);
  return out;
}

/// Every place of the edge is as far from the way as the tool's radius.
void expect_at_the_radius(const std::vector<Piece>& edge, const std::vector<CutMove>& moves) {
  for (const Piece& piece : edge) {
    for (const double t : {0.0, 0.3, 0.7, 1.0}) {
      double nearest = 1e300;
      for (const CutMove& move : moves) {
        nearest = std::min(nearest, cutting::distance_from(move.piece, evaluate(piece, t).point));
      }
      EXPECT_NEAR(nearest, kToolRadius, 1e-3 * kToolRadius);
    }
  }
}

TEST(EdgeOfCut, OfALineIsASlotWithRoundEnds) {
  const auto moves = along({{0, 0}, {kLegLength, 0}});
  const auto edge = edge_of_cut(moves, kToolRadius, 0.01);
  EXPECT_NEAR(length_of_all(edge), 2.0 * kLegLength + 2.0 * kPi * kToolRadius, 1e-9);
  expect_at_the_radius(edge, moves);
}

TEST(EdgeOfCut, IsRoundAtAnOuterCornerAndTrimmedAtAnInnerOne) {
  for (const double turn : {1.0, -1.0}) {
    const auto moves = along({{0, 0}, {kLegLength, 0}, {kLegLength, turn * kLegLength}});
    const auto edge = edge_of_cut(moves, kToolRadius, 0.01);
    const double expected = 2.0 * kLegLength + 0.5 * kPi * kToolRadius +
                            2.0 * (kLegLength - kToolRadius) + 2.0 * kPi * kToolRadius;
    EXPECT_NEAR(length_of_all(edge), expected, 0.01);
    expect_at_the_radius(edge, moves);
  }
}

TEST(EdgeOfCut, OfAClosedSquareHasNoEnds) {
  const auto moves =
      along({{0, 0}, {kLegLength, 0}, {kLegLength, kLegLength}, {0, kLegLength}, {0, 0}});
  const auto edge = edge_of_cut(moves, kToolRadius, 0.01);
  const double inner = 4.0 * (kLegLength - 2.0 * kToolRadius);
  EXPECT_NEAR(length_of_all(edge), 4.0 * kLegLength + 2.0 * kPi * kToolRadius + inner, 0.01);
  expect_at_the_radius(edge, moves);
}

/// Arcs over the chords between places as programs print them.
CutMove printed_arc(Vec2 from, Vec2 to, double radius, double turn) {
  const auto digits = [](Vec2 p) {
    return Vec2{std::round(1e3 * p.x) / 1e3, std::round(1e3 * p.y) / 1e3};
  };
  const Vec2 a = digits(from), b = digits(to);
  const double half = std::asin(0.5 * norm(b - a) / radius);
  const double own = turn > kPi ? 2.0 * kPi - 2.0 * half : 2.0 * half;
  return {CutMoveKind::kCut,
          ArcPiece{a, b, heading(b - a) - 0.5 * own, 1.0 / radius, own * radius}};
}

// A circle in three arcs whose ends are printed: its edges are two circles.
TEST(EdgeOfCut, OfAPrintedCircleIsTwoCircles) {
  constexpr double kWay = 6.5, kFirst = 0.3;
  std::vector<CutMove> moves;
  const Vec2 centre{30.0, 30.0};
  for (int k = 0; k < 3; ++k) {
    const double from = kFirst + 2.0 * kPi / 3.0 * k, to = from + 2.0 * kPi / 3.0;
    moves.push_back(printed_arc(centre + kWay * Vec2{std::cos(from), std::sin(from)},
                                centre + kWay * Vec2{std::cos(to), std::sin(to)}, kWay,
                                2.0 * kPi / 3.0));
  }
  const auto edge = edge_of_cut(moves, kToolRadius, 0.01);
  ASSERT_EQ(edge.size(), 2U);
  std::vector<double> lengths;
  for (const Piece& piece : edge) {
    EXPECT_EQ(start_point(piece), end_point(piece));
    lengths.push_back(cutting::length_of(piece));
    for (const double t : {0.0, 0.2, 0.4, 0.6, 0.8}) {
      const double off = norm(evaluate(piece, t).point - centre) - kWay;
      EXPECT_NEAR(std::abs(off), kToolRadius, 2e-3);
    }
  }
  std::sort(lengths.begin(), lengths.end());
  EXPECT_NEAR(lengths[0], 2.0 * kPi * (kWay - kToolRadius), 0.01);
  EXPECT_NEAR(lengths[1], 2.0 * kPi * (kWay + kToolRadius), 0.01);
}

// Around a corner with an arc that is a little larger than the tool: of the inner edge the corner
// is left, where both sides meet.
TEST(EdgeOfCut, HasNoSliversAndItsLoopsAreClosed) {
  constexpr double kRounding = 7e-4, kRadius = kToolRadius + kRounding;
  std::vector<CutMove> moves;
  const double side = 20.0;
  // a square with rounded corners, ends as printed
  const Vec2 corner[] = {{side, 0}, {side, side}, {0, side}, {0, 0}};
  for (int k = 0; k < 4; ++k) {
    const double a = 0.5 * kPi * (k - 1), b = a + 0.5 * kPi;
    const Vec2 from = corner[k] + kRadius * Vec2{std::cos(a), std::sin(a)};
    const CutMove round =
        printed_arc(from, corner[k] + kRadius * Vec2{std::cos(b), std::sin(b)}, kRadius, 0.5 * kPi);
    if (!moves.empty()) {
      moves.push_back(
          {CutMoveKind::kCut, LinePiece{end_point(moves.back().piece), start_point(round.piece)}});
    }
    moves.push_back(round);
  }
  moves.push_back({CutMoveKind::kCut,
                   LinePiece{end_point(moves.back().piece), start_point(moves.front().piece)}});
  const auto edge = edge_of_cut(moves, kToolRadius, 0.01);
  EXPECT_EQ(edge.size(), 12U);  // four lines inside, four lines and four arcs outside
  for (const Piece& piece : edge) {
    EXPECT_GT(cutting::length_of(piece), 1.0);
    const auto begins = std::count_if(edge.begin(), edge.end(), [&](const Piece& other) {
      return start_point(other) == end_point(piece);
    });
    EXPECT_EQ(begins, 1);
  }
  const double outer = 2.0 * kToolRadius;
  EXPECT_NEAR(length_of_all(edge), 8.0 * side + 2.0 * kPi * outer, 0.02);
}

TEST(EdgeOfCut, IsNoneWithoutATool) {
  EXPECT_TRUE(edge_of_cut(along({{0, 0}, {kLegLength, 0}}), 0.0, 0.01).empty());
}

}  // namespace
}  // namespace obvid
