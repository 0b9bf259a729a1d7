// SPDX-License-Identifier: Apache-2.0
// What a round tool leaves beside its way, by closed forms.
#include "obvid/cutting/internal/edge_of_cut.h"

#include <gtest/gtest.h>

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

TEST(EdgeOfCut, IsNoneWithoutATool) {
  EXPECT_TRUE(edge_of_cut(along({{0, 0}, {kLegLength, 0}}), 0.0, 0.01).empty());
}

}  // namespace
}  // namespace obvid
