// SPDX-License-Identifier: Apache-2.0
// Points with errors of a known deviation, made here: the estimate must find it.
#include "obvid/series/internal/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace obvid {
namespace {

using Shape = Vec2 (*)(double);

/// A normal number, the same on every machine.
double normal_of(std::mt19937& random) {
  const auto uniform = [&] { return (double(random()) + 0.5) / 4294967296.0; };
  const double radius = std::sqrt(-2.0 * std::log(uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

Vec2 ellipse(double t) { return {50.0 * std::cos(t), 20.0 * std::sin(t)}; }
Vec2 meander(double t) { return {10.0 * t, 5.0 * std::sin(t)}; }

std::vector<Vec2> measured(Shape shape, int count, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Vec2> out;
  for (int k = 0; k < count; ++k) {
    const Vec2 p = shape(6.0 * k / count);
    out.push_back({p.x + sigma * normal_of(random), p.y + sigma * normal_of(random)});
  }
  return out;
}

double middle_of(std::vector<double> all) {
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

TEST(Scatter, FindsTheDeviationThatPointsWereMadeWith) {
  for (const Shape shape : {&ellipse, &meander}) {
    for (const double sigma : {1e-4, 1e-3, 1e-2}) {
      std::vector<double> found;
      for (unsigned seed = 1; seed <= 25; ++seed) {
        const auto one = scatter_of(measured(shape, 400, sigma, seed));
        ASSERT_TRUE(one) << sigma;
        // 400 residuals, of which neighbours depend on each other: far outside chance
        EXPECT_NEAR(one->deviation, sigma, 0.3 * sigma);
        EXPECT_EQ(one->places, 396U);
        found.push_back(one->deviation);
      }
      EXPECT_NEAR(middle_of(found), sigma, 0.05 * sigma);
    }
  }
}

TEST(Scatter, HoldsAllPointsNineteenTimesOutOfTwenty) {
  int held = 0, all = 0;
  for (unsigned seed = 100; seed < 300; ++seed, ++all) {
    const double sigma = 1e-3;
    std::mt19937 random(seed);
    std::vector<Vec2> line;
    double largest = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double off = sigma * normal_of(random);
      largest = std::max(largest, std::abs(off));
      line.push_back({0.1 * k, off});
    }
    const auto one = scatter_of(line);
    ASSERT_TRUE(one);
    held += one->bound >= largest ? 1 : 0;
  }
  EXPECT_GE(held, all * 95 / 100);
}

/// Of equally spaced points across their line: the middle of five is off the cubic through the
/// others by a sixth of the fourth difference, whose variance is 70 (Abramowitz, Stegun
/// 1964, 25.1.1).
double deviation_of_differences(const std::vector<double>& across, std::size_t stride) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i + 4 * stride < across.size(); ++i) {
    const auto e = [&](std::size_t k) { return across[i + k * stride]; };
    sizes.push_back(std::abs(e(0) - 4.0 * e(1) + 6.0 * e(2) - 4.0 * e(3) + e(4)));
  }
  return 1.482602218505602 * middle_of(std::move(sizes)) / std::sqrt(70.0);
}

TEST(Scatter, KeepsTheDigitsOfErrorsFarBelowTheCoordinates) {
  // steps of 5 * 2^16 along (3, 4), errors of 5 * 2^-30 across or none: all of them exact
  constexpr int kCount = 41;
  constexpr double kStep = 0x1p16, kError = 0x1p-30;
  std::mt19937 random(11);
  std::vector<Vec2> points;
  std::vector<double> across;
  for (int k = 0; k < kCount; ++k) {
    const double e = kError * (static_cast<double>(random() % 3) - 1.0);
    points.push_back({3.0 * kStep * k - 4.0 * e, 4.0 * kStep * k + 3.0 * e});
    across.push_back(5.0 * e);
  }
  const double near = deviation_of_differences(across, 1),
               far = deviation_of_differences(across, 2);
  const auto one = scatter_of(points);
  ASSERT_TRUE(one);
  const double expected = std::sqrt((256.0 * near * near - far * far) / 255.0);
  EXPECT_NEAR(one->deviation, expected, 1e-9 * expected);
}

TEST(Scatter, IsTakenFromMostPointsWhateverTheOthersAre) {
  std::vector<Vec2> points = measured(&meander, 400, 1e-3, 7);
  for (std::size_t k = 10; k < points.size(); k += 40) points[k].y += 2.0;
  const auto one = scatter_of(points);
  ASSERT_TRUE(one);
  EXPECT_NEAR(one->deviation, 1e-3, 1e-3);  // a fifth of the residuals holds an outlier
}

TEST(Scatter, TurnsMovesAndScalesWithThePoints) {
  const std::vector<Vec2> points = measured(&ellipse, 200, 1e-2, 3);
  const double before = scatter_of(points)->deviation;
  for (const double scale : {1e-9, 1.0, 1e9}) {
    std::vector<Vec2> placed;
    for (const Vec2 p : points) {
      placed.push_back(scale * Vec2{0.6 * p.x - 0.8 * p.y + 300.0, 0.8 * p.x + 0.6 * p.y - 100.0});
    }
    EXPECT_NEAR(scatter_of(placed)->deviation / scale, before, 1e-9 * before);
  }
}

TEST(Scatter, OfSmoothPointsIsNotKnown) {
  for (const Shape shape : {&ellipse, &meander}) {
    for (const int count : {40, 100, 200}) {
      const auto none = scatter_of(measured(shape, count, 0.0, 1));
      ASSERT_FALSE(none) << count;
      EXPECT_EQ(none.error().code, ErrorCode::kNothingThere);
    }
  }
}

TEST(Scatter, OfFewPointsIsNotKnown) {
  const auto none = scatter_of(measured(&ellipse, 20, 1e-2, 1));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(scatter_of({}).error().code, ErrorCode::kTooFewPoints);
}

TEST(Scatter, OfPointsThatAreAllOneIsNotKnown) {
  EXPECT_FALSE(scatter_of(std::vector<Vec2>(100, Vec2{1.0, 2.0})));
}

}  // namespace
}  // namespace obvid
