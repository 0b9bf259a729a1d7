// SPDX-License-Identifier: Apache-2.0
// The lower bound on vertices: never above what a curve within the tolerances has, and equal to it
// where the data are plain.
#include "obvid/series/internal/forced_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include "known_vertices.h"

namespace obvid {
namespace {

using namespace test;

int forced(const std::vector<Vec2>& points, double reach, bool closed = false) {
  return forced_vertices(points, std::vector<double>(points.size(), reach), closed);
}

TEST(ForcedVertices, NoiseOnASpiralForcesNone) {
  std::mt19937_64 rng(1);
  for (int i = 0; i < 300; ++i) {
    const std::size_t n = 6 + static_cast<std::size_t>(rng() % 600);
    auto points = clothoid(n, 2.0, uniform(rng, -2.0, 2.0), uniform(rng, 0.0, 2.0));
    const double reach = std::pow(10.0, uniform(rng, -9.0, -2.0));
    add_noise(points, reach, rng);
    EXPECT_EQ(forced(points, reach), 0) << i << ": " << n << " points, " << reach;
  }
}

TEST(ForcedVertices, ExactPointsOfAWaveForceEveryVertex) {
  for (const int waves : {1, 2, 5, 20}) {
    for (const std::size_t per_wave : {30, 100, 400}) {
      const auto points = meander(per_wave * static_cast<std::size_t>(waves), waves, 1.0);
      EXPECT_EQ(forced(points, 1e-12), 2 * waves - 1) << per_wave;
    }
  }
}

TEST(ForcedVertices, AreFewerWithMoreTolerance) {
  const auto points = meander(1000, 5.0, 0.5);
  int before = 9;
  for (const double reach : {1e-10, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2, 0.1}) {
    const int now = forced(points, reach);
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
    EXPECT_EQ(forced(points, 0.5 * (*high - *low)), 0) << turn;
    EXPECT_EQ(forced(points, 0.01 * (*high - *low)), 5) << turn;
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
    const int found = forced(points, reach), true_ones = curve.vertices(0.0, 2.0);
    EXPECT_LE(found, true_ones) << i << ": " << n << " points, reach " << reach;
    tight += found == true_ones ? 1 : 0;
  }
  std::printf("as many as the curve has: %d of %d\n", tight, kCurves);
  EXPECT_GT(tight, kCurves / 5);  // a bound of 0 would pass otherwise
}

TEST(ForcedVertices, AnEllipseForcesFourAndASpiralLoopsSeamIsNotCountedTwice) {
  std::mt19937_64 rng(3);
  for (int i = 0; i < 100; ++i) {
    const std::size_t n = 40 + static_cast<std::size_t>(rng() % 200);
    auto points = ellipse(n, 2.0, 1.0, uniform(rng, 0.0, kTurn));
    EXPECT_EQ(forced(points, 1e-9, true), 4) << n;
    const double reach = std::pow(10.0, uniform(rng, -6.0, -2.0));
    add_noise(points, reach, rng);
    EXPECT_LE(forced(points, reach, true), 4) << n << ", " << reach;
  }
}

TEST(ForcedVertices, ManyMorePointsThanTheReachNeedsAreStillCounted) {
  std::mt19937_64 rng(4);
  auto points = meander(100000, 5.0, 1.0);
  add_noise(points, 1e-4, rng);
  EXPECT_EQ(forced(points, 1e-4), 9);
}

/// Half of all series exact, half with noise up to half a percent of the size, evenly in the discs.
double make_noisy(std::vector<Vec2>& points, std::mt19937_64& rng) {
  if (rng() % 2 == 0) return 0.0;
  const double reach = size_of_points(points) * std::pow(10.0, uniform(rng, -9.0, -2.3));
  add_noise(points, reach, rng);
  return reach;
}

/// Coils whose neighbouring points see less than half a turn of the curve: beyond, points say
/// nothing about how often it went round between them, and the curve is none of those that the
/// bound speaks of.
TEST(ForcedVertices, CoilsOfMonotoneCurvatureAreForcedToHaveNone) {
  std::mt19937_64 rng(5);
  int judged = 0, winding = 0;
  for (std::size_t i = 0; judged < 5000; ++i) {
    Coil coil = random_coil(i, rng);
    if (coil.largest_turn >= std::numbers::pi) continue;
    const double reach = make_noisy(coil.points, rng);
    EXPECT_EQ(forced(coil.points, reach), 0)
        << i << ": " << coil.name << ", " << coil.points.size() << " points, reach " << reach;
    ++judged;
    winding += coil.points.size() > 20 ? 1 : 0;
  }
  EXPECT_GT(winding, 2000);
}

/// What the bound had on the same curves when it compared wherever neighbouring chords turn by less
/// than a right angle: as many as the curve has on 1,308, and this many altogether.
constexpr int kSharpBefore = 1308, kSumBefore = 8088;

TEST(ForcedVertices, NeverExceedThoseOfCurvesOfKnownNumber) {
  std::mt19937_64 rng(6);
  constexpr int kCurves = 2000;
  int sharp = 0, sum = 0;
  for (std::size_t i = 0; i < kCurves; ++i) {
    const KnownCurve curve = random_known_curve(i, rng);
    const auto n = 6 + static_cast<std::size_t>(std::pow(10.0, uniform(rng, 0.3, 2.6)));
    std::vector<double> at = strides(curve.closed ? n + 1 : n, curve.from, curve.to, rng);
    if (curve.closed) at.pop_back();
    std::vector<Vec2> points;
    for (const double t : at) points.push_back(curve.at(t).p);
    const double reach = make_noisy(points, rng);
    const int found = forced(points, reach, curve.closed), vertices = curve.vertices();
    EXPECT_LE(found, vertices) << i << ": " << curve.name << ", " << n << " points, reach "
                               << reach;
    sharp += found == vertices ? 1 : 0;
    sum += found;
  }
  std::printf("as many as the curve has: %d of %d; %d altogether\n", sharp, kCurves, sum);
  EXPECT_GE(sharp, kSharpBefore);
  EXPECT_GE(sum, kSumBefore);
}

/// Curvature 6 (1 - s^2), whose one vertex lies in a gap over which the curve turns by 2.4 rad:
/// what rises before it and falls behind it has turned round somewhere between.
TEST(ForcedVertices, ShowBeyondGapsThatTurnTooFarToBeCompared) {
  std::vector<double> at;
  for (int i = 0; i <= 15; ++i) at.push_back(0.05 * i);
  for (int i = 0; i <= 15; ++i) at.push_back(1.15 + 0.05 * i);
  const auto heading = [](double along) {
    const double s = along - 0.95;
    return 6.0 * (s - s * s * s / 3.0);
  };
  EXPECT_NEAR(heading(1.15) - heading(0.75), 2.4, 0.05);
  const std::vector<Vec2> points = trace(heading, at, 1e-3);
  EXPECT_EQ(forced(points, 0.0), 1);
  EXPECT_EQ(forced(points, 1e-6), 1);
}

}  // namespace
}  // namespace obvid
