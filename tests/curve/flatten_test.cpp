// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/flatten.h"
#include "obvid/curve/internal/runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

/// A circle arc of radius 5 that turns by 2 rad.
const Piece kArc = ArcPiece{{0, 0}, {5 * std::sin(2.0), 5 - 5 * std::cos(2.0)}, 0.0, 0.2, 10.0};

TEST(Flatten, MeasuresTheSagittasOfACircle) {
  for (const int steps : {1, 2, 7, 64}) {
    EXPECT_NEAR(largest_sagitta(kArc, steps), 5 * (1 - std::cos(1.0 / steps)), 1e-14) << steps;
  }
}

TEST(Flatten, DoublesStepsUntilChordsAreNear) {
  const double tolerance = 1e-3;  // 1 - cos(1/n) <= 2e-4 from n = 50 on
  EXPECT_EQ(chord_steps(kArc, tolerance, 2, 1 << 20), 64);
  EXPECT_EQ(chord_steps(kArc, tolerance, 3, 1 << 20), 96);
  EXPECT_EQ(chord_steps(kArc, tolerance, 2, 16), 16);
  EXPECT_EQ(chord_steps(LinePiece{{0, 0}, {1, 1}}, tolerance, 1, 16), 1);
}

TEST(Flatten, CountsAPieceThatReturnsByItsDistance) {
  RationalBezier loop{{}, 2, {Vec2{0, 0}, {2, 0}, {0, 0}}, {1, 1, 1}};
  EXPECT_EQ(largest_sagitta(loop, 1), 1.0);  // its middle, from a chord without length
}

TEST(Runs, JoinNeighboursOfOneDirection) {
  const std::vector<int> direction = {1, 1, 0, -1, -1, -1, 1};
  const auto runs = collect_runs(direction);
  ASSERT_EQ(runs.size(), 4U);
  EXPECT_EQ(runs[2].first_piece, 3U);
  EXPECT_EQ(runs[2].last_piece, 5U);
  EXPECT_EQ(runs[2].direction, -1);
  const auto cut = collect_runs(direction, [](std::size_t i) { return i == 4; });
  ASSERT_EQ(cut.size(), 5U);
  EXPECT_EQ(cut[2].last_piece, 3U);
  EXPECT_EQ(cut[3].first_piece, 4U);
  EXPECT_TRUE(collect_runs({}).empty());
}

}  // namespace
}  // namespace obvid
