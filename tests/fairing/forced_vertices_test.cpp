// SPDX-License-Identifier: Apache-2.0
// The lower bound on vertices: never above what a curve within the tolerances has, and equal to it
// where the data are plain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "measured_curves.h"

namespace obvid {
namespace {

using namespace test;

TEST(ForcedVertices, NoiseOnASpiralForcesNone) {
  std::mt19937_64 rng(1);
  for (int i = 0; i < 300; ++i) {
    const std::size_t n = 6 + static_cast<std::size_t>(rng() % 600);
    auto points = clothoid(n, 2.0, uniform(rng, -2.0, 2.0), uniform(rng, 0.0, 2.0));
    const double reach = std::pow(10.0, uniform(rng, -9.0, -2.0));
    add_noise(points, reach, rng);
    EXPECT_EQ(forced_vertices(measured(points, reach)), 0)
        << i << ": " << n << " points, " << reach;
  }
}

TEST(ForcedVertices, ExactPointsOfAWaveForceEveryVertex) {
  for (const int waves : {1, 2, 5, 20}) {
    for (const std::size_t per_wave : {30, 100, 400}) {
      const auto points = meander(per_wave * static_cast<std::size_t>(waves), waves, 1.0);
      EXPECT_EQ(forced_vertices(measured(points, 1e-12)), 2 * waves - 1) << per_wave;
    }
  }
}

TEST(ForcedVertices, AreFewerWithMoreTolerance) {
  const auto points = meander(1000, 5.0, 0.5);
  int before = 9;
  for (const double reach : {1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.1}) {
    const int now = forced_vertices(measured(points, reach));
    EXPECT_LE(now, before) << reach;
    before = now;
  }
  EXPECT_EQ(before, 0);  // a straight line is within 0.1 of all points
}

/// The wave is no higher than a straight line's tolerance allows: height of the curve theta =
/// turn sin(2 pi s) over its axis is about turn / pi from trough to crest.
TEST(ForcedVertices, AreNoneWhereAStraightLineWouldDo) {
  for (const double turn : {1e-3, 1e-2, 0.1}) {
    const auto points = meander(500, 3.0, turn);
    std::vector<double> y;
    for (const Vec2 p : points) y.push_back(p.y);
    const auto [low, high] = std::minmax_element(y.begin(), y.end());
    EXPECT_NEAR(*high - *low, turn / std::numbers::pi, 0.01 * turn);
    EXPECT_EQ(forced_vertices(measured(points, 0.5 * (*high - *low))), 0) << turn;
    EXPECT_EQ(forced_vertices(measured(points, 0.01 * (*high - *low))), 5) << turn;
  }
}

/// Heading = a random sum of sines, so that the vertices are the changes of sign of its second
/// derivative, counted on a fine grid.
struct RandomCurve {
  std::vector<double> size, wave, phase;
  double bend = 0.0;

  explicit RandomCurve(std::mt19937_64& rng) : bend(uniform(rng, -2.0, 2.0)) {
    const std::size_t terms = 1 + rng() % 4;
    for (std::size_t k = 0; k < terms; ++k) {
      wave.push_back(uniform(rng, 3.0, 40.0));
      size.push_back(uniform(rng, 0.1, 1.0) / static_cast<double>(terms));
      phase.push_back(uniform(rng, 0.0, kTurn));
    }
  }
  [[nodiscard]] double heading(double s) const {
    double sum = bend * s;
    for (std::size_t k = 0; k < size.size(); ++k) sum += size[k] * std::sin(wave[k] * s + phase[k]);
    return sum;
  }
  [[nodiscard]] int vertices(double from, double to) const {
    constexpr int kGrid = 20000;
    int n = 0;
    double last = 0.0;
    for (int i = 0; i <= kGrid; ++i) {
      const double s = from + (to - from) * i / kGrid;
      double rate = 0.0;
      for (std::size_t k = 0; k < size.size(); ++k) {
        rate -= size[k] * wave[k] * wave[k] * std::sin(wave[k] * s + phase[k]);
      }
      if (last * rate < 0.0) ++n;
      last = rate;
    }
    return n;
  }
};

TEST(ForcedVertices, NeverExceedThoseOfTheCurveThatTheNoisyPointsCameFrom) {
  std::mt19937_64 rng(2);
  int tight = 0;
  constexpr int kCurves = 1500;
  for (int i = 0; i < kCurves; ++i) {
    const RandomCurve curve(rng);
    const std::size_t n = 20 + static_cast<std::size_t>(rng() % 400);
    std::vector<double> at = even_steps(n, 2.0);
    if (rng() % 2 == 0) {  // uneven
      for (std::size_t k = 1; k + 1 < n; ++k) {
        at[k] += uniform(rng, -0.45, 0.45) * 2.0 / static_cast<double>(n - 1);
      }
    }
    auto points = trace([&](double s) { return curve.heading(s); }, at, 1e-3);
    const double reach = std::pow(10.0, uniform(rng, -9.0, -2.5));
    add_noise(points, reach, rng);
    const int forced = forced_vertices(measured(points, reach)),
              true_ones = curve.vertices(0.0, 2.0);
    EXPECT_LE(forced, true_ones) << i << ": " << n << " points, reach " << reach;
    tight += forced == true_ones ? 1 : 0;
  }
  std::printf("as many as the curve has: %d of %d\n", tight, kCurves);
  EXPECT_GT(tight, kCurves / 5);  // a bound of 0 would pass otherwise
}

TEST(ForcedVertices, AnEllipseForcesFourAndASpiralLoopsSeamIsNotCountedTwice) {
  std::mt19937_64 rng(3);
  for (int i = 0; i < 100; ++i) {
    const std::size_t n = 40 + static_cast<std::size_t>(rng() % 200);
    auto points = ellipse(n, 2.0, 1.0, uniform(rng, 0.0, kTurn));
    EXPECT_EQ(forced_vertices(measured(points, 1e-9, true)), 4) << n;
    const double reach = std::pow(10.0, uniform(rng, -6.0, -2.0));
    add_noise(points, reach, rng);
    EXPECT_LE(forced_vertices(measured(points, reach, true)), 4) << n << ", " << reach;
  }
}

TEST(ForcedVertices, ManyMorePointsThanTheReachNeedsAreStillCounted) {
  std::mt19937_64 rng(4);
  auto points = meander(100000, 5.0, 1.0);
  add_noise(points, 1e-4, rng);
  EXPECT_EQ(forced_vertices(measured(points, 1e-4)), 9);
}

}  // namespace
}  // namespace obvid
