// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/straight_rows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace obvid {
namespace {

using RowPoints = std::vector<Vec2>;
constexpr double kTurn = 2.0 * std::numbers::pi;

RowPoints regular_row(int corners, double radius = 1.0) {
  RowPoints out;
  for (int k = 0; k < corners; ++k) out.push_back(radius * unit_at(kTurn * k / corners));
  return out;
}

const RowPoints kRowRectangle{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
const RowPoints kTriangle{{0, 0}, {4, 0}, {1, 3}};
const RowPoints kEll{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}};
const RowPoints kChamfered{{1, 0}, {3, 0}, {4, 1}, {4, 2}, {3, 3}, {1, 3}, {0, 2}, {0, 1}};

TEST(StraightRows, EdgesOfPolygonsAreNoChordsOfACurve) {
  for (const RowPoints& polygon : {kRowRectangle, kTriangle, kEll, kChamfered}) {
    EXPECT_FALSE(chords_of_curve(polygon, true));
    EXPECT_FALSE(chords_of_curve(polygon, false));
  }
  for (int corners = 3; corners <= 13; ++corners) {
    EXPECT_FALSE(chords_of_curve(regular_row(corners), true)) << corners;
  }
}

TEST(StraightRows, ManyShortChordsAreACurve) {
  for (int corners = 14; corners <= 2000; corners += 7) {
    EXPECT_TRUE(chords_of_curve(regular_row(corners), true)) << corners;
  }
}

TEST(StraightRows, TheScaleDoesNotMatter) {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    EXPECT_TRUE(chords_of_curve(regular_row(40, scale), true));
    EXPECT_FALSE(chords_of_curve(regular_row(6, scale), true));
  }
}

TEST(StraightRows, ThreeTurnsMakeACurveAndTwoABend) {
  const auto bent = [](std::vector<double> degrees) {
    RowPoints out{{0, 0}, {1, 0}};
    double theta = 0.0;
    for (const double turn : degrees) {
      theta += turn * kTurn / 360.0;
      out.push_back(out.back() + unit_at(theta));
    }
    return chords_of_curve(out, false);
  };
  EXPECT_TRUE(bent({10, 10, 10}));
  EXPECT_FALSE(bent({10, 10}));
  EXPECT_TRUE(bent({1, 2, 3, 4}));
  EXPECT_FALSE(bent({1, 20, 1}));         // a bend between nearly straight walls
  EXPECT_TRUE(bent({90, 5, 5, 5, 90}));   // a flank between corners
  EXPECT_FALSE(bent({90, 0, 0, 0, 90}));  // an edge with points on it
  EXPECT_TRUE(bent({10, 10, 10, -10, -10, -10}));
  EXPECT_FALSE(bent({30, 30, 30, 30}));
}

// Errors of points on a line turn chords to and fro: sums of turns are differences of headings.
TEST(StraightRows, RoundedPointsOnEdgesNeverMakeACurve) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> error(-1.0, 1.0), step(0.2, 1.8);
  int tried = 0;
  for (int k = 0; k < 10000; ++k) {
    const int count = 3 + static_cast<int>(random() % 40);
    RowPoints line;
    double x = 0.0;
    for (int i = 0; i < count; ++i) {
      line.push_back({x, 1e-6 * error(random)});
      x += step(random);
    }
    tried += chords_of_curve(line, false) ? 1 : 0;
  }
  EXPECT_LE(tried, 100);  // one in a hundred, of short rows of three and four turns
}

TEST(StraightRows, WhereAClosedSeriesBeginsDoesNotMatter) {
  RowPoints shape = regular_row(60);
  shape.erase(shape.begin() + 20, shape.begin() + 40);  // a D, its flat side from 20 to 40
  for (std::size_t k = 0; k < shape.size(); ++k) {
    EXPECT_TRUE(chords_of_curve(shape, true)) << k;
    std::rotate(shape.begin(), shape.begin() + 1, shape.end());
  }
}

}  // namespace
}  // namespace obvid
