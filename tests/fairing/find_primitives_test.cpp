// SPDX-License-Identifier: Apache-2.0
// Lines and circles in measured points: those that were drawn are found, others are not made up.
#include "find_primitives.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "measured_curves.h"

namespace obvid::fairing_detail {
namespace {

using namespace test;

/// Points of a curve of given curvature every `step`, moved at random within `noise`.
SmoothPoints points_of(const std::function<double(double)>& heading,
                       const std::function<double(double)>& kappa, double length, double step,
                       double noise, double reach) {
  SmoothPoints out;
  for (double s = 0.0; s <= length + 0.5 * step; s += step) out.at.push_back(s);
  out.points = trace(heading, out.at, 0.1 * step);
  std::mt19937_64 rng(7);
  for (std::size_t i = 0; i < out.at.size(); ++i) {
    const double angle = test::uniform(rng, 0.0, kTurn),
                 r = noise * std::sqrt(test::uniform(rng, 0.0, 1.0));
    out.points[i] = out.points[i] + r * Vec2{std::cos(angle), std::sin(angle)};
    out.kappa.push_back(kappa(out.at[i]));
  }
  out.reach.assign(out.at.size(), reach);
  out.free.assign(out.at.size(), true);
  return out;
}

std::vector<Primitive> found(const SmoothPoints& series) {
  Watch nobody;
  return find_primitives(series, nobody);
}

/// A line of length 2, an arc of radius 0.5 over a right angle, a line of length 2.
constexpr double kLine = 2.0, kRadius = 0.5, kArc = 0.25 * kTurn * kRadius;
double heading_of_bend(double s) {
  return std::clamp((s - kLine) / kRadius, 0.0, kArc / kRadius);
}
double kappa_of_bend(double s) { return s < kLine || s > kLine + kArc ? 0.0 : 1.0 / kRadius; }

TEST(FindPrimitives, LineArcAndLineAreFoundWithTheirSizes) {
  for (const double noise : {0.0, 2e-4}) {
    constexpr double kReach = 1e-3;
    const SmoothPoints series =
        points_of(heading_of_bend, kappa_of_bend, 2.0 * kLine + kArc, 0.02, noise, kReach);
    const std::vector<Primitive> all = found(series);
    ASSERT_EQ(all.size(), 3U) << noise;
    EXPECT_EQ(all[0].kappa, 0.0);
    EXPECT_NEAR(all[1].kappa, 1.0 / kRadius, 0.02 / kRadius);
    EXPECT_EQ(all[2].kappa, 0.0);
    EXPECT_NEAR(std::remainder(all[0].theta, kTurn), 0.0, 1e-3);
    EXPECT_NEAR(std::remainder(all[2].theta - 0.25 * kTurn, kTurn), 0.0, 1e-3);
    for (std::size_t k = 0; k < all.size(); ++k) {
      EXPECT_LT(all[k].first, all[k].last);
      if (k > 0) {
        EXPECT_LT(all[k - 1].last, all[k].first);  // no point in common
      }
      for (std::size_t i = all[k].first; i <= all[k].last; ++i) {
        const Vec2 from = series.points[i] - all[k].anchor;
        const Vec2 left{-std::sin(all[k].theta), std::cos(all[k].theta)};
        // from the line or circle through the anchor: (|p|^2 kappa - 2 p.left) / (|kappa p - left| + 1)
        const Vec2 out = all[k].kappa * from - left;
        const double off = std::abs(dot(from, from) * all[k].kappa - 2.0 * dot(from, left)) /
                           (norm(out) + 1.0);
        EXPECT_LE(off, kReach) << "primitive " << k << ", point " << i;
      }
    }
    // nearly all points belong to one: beside the joints some may not
    std::size_t taken = 0;
    for (const Primitive& p : all) taken += p.last - p.first + 1;
    EXPECT_GE(static_cast<double>(taken), 0.8 * static_cast<double>(series.points.size()));
  }
}

TEST(FindPrimitives, AClothoidHasNone) {
  const auto heading = [](double s) { return 0.5 * s * s; };
  const SmoothPoints series =
      points_of(heading, [](double s) { return s; }, 3.0, 0.02, 0.0, 1e-4);
  EXPECT_TRUE(found(series).empty());
}

TEST(FindPrimitives, PointsWithSomethingGivenAreLeftAlone) {
  SmoothPoints series = points_of([](double) { return 0.3; }, [](double) { return 0.0; }, 4.0, 0.02,
                                  0.0, 1e-3);
  const std::size_t given = series.points.size() / 2;
  series.free[given] = false;
  for (const Primitive& p : found(series)) {
    EXPECT_FALSE(p.first <= given && given <= p.last);
  }
}

TEST(FindPrimitives, SizeAndPlaceDoNotMatter) {
  SmoothPoints series =
      points_of(heading_of_bend, kappa_of_bend, 2.0 * kLine + kArc, 0.02, 2e-4, 1e-3);
  const std::vector<Primitive> here = found(series);
  constexpr double kSize = 1024.0;  // of two: nothing is rounded
  for (Vec2& p : series.points) p = kSize * Vec2{-p.y, p.x};
  for (double& r : series.reach) r *= kSize;
  for (double& s : series.at) s *= kSize;
  for (double& k : series.kappa) k /= kSize;
  const std::vector<Primitive> there = found(series);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_EQ(here[k].first, there[k].first);
    EXPECT_EQ(here[k].last, there[k].last);
    EXPECT_NEAR(here[k].kappa, kSize * there[k].kappa, 1e-9);
  }
}

}  // namespace
}  // namespace obvid::fairing_detail
