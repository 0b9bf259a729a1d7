// SPDX-License-Identifier: Apache-2.0
// Points of known curves, shuffled: the order must be that of the curve.
#include "obvid/series/internal/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace obvid {
namespace {

using Row = std::vector<Vec2>;

Row spiral_row(int count) {
  Row out;
  for (int k = 0; k < count; ++k) out.push_back((1.0 + 0.01 * k) * unit_at(8.0 * k / count));
  return out;
}

Row ellipse_row(int count) {
  Row out;
  for (int k = 0; k < count; ++k) {
    const Vec2 e = unit_at(2.0 * std::numbers::pi * k / count);
    out.push_back({30.0 * e.x, 10.0 * e.y});
  }
  return out;
}

std::vector<std::size_t> shuffled_indices(std::size_t n, unsigned seed) {
  std::vector<std::size_t> out(n);
  std::iota(out.begin(), out.end(), std::size_t{0});
  std::mt19937 random(seed);
  for (std::size_t k = n - 1; k > 0; --k) std::swap(out[k], out[random() % (k + 1)]);
  return out;
}

/// Indices on the curve of what was put in order.
std::vector<std::size_t> found_order(const Row& row, unsigned seed, double scale = 1.0) {
  const auto mixed = shuffled_indices(row.size(), seed);
  Row list;
  for (const std::size_t i : mixed) list.push_back(scale * row[i]);
  const auto found = order_along_curve(list);
  if (!found) return {};
  std::vector<std::size_t> out;
  for (const std::size_t i : found->order) out.push_back(mixed[i]);
  return out;
}

TEST(CurveOrder, OfAnOpenCurveIsThatOfTheCurve) {
  const Row row = spiral_row(300);
  std::vector<std::size_t> expected(row.size());
  std::iota(expected.begin(), expected.end(), std::size_t{0});
  for (unsigned seed = 1; seed <= 10; ++seed) {
    for (const double scale : {1e-9, 1.0, 1e9}) {
      auto found = found_order(row, seed, scale);
      ASSERT_FALSE(found.empty());
      if (found.front() != 0) std::reverse(found.begin(), found.end());
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(CurveOrder, OfAClosedCurveGoesAroundOnce) {
  const std::size_t n = 120;
  const Row row = ellipse_row(static_cast<int>(n));
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto found = found_order(row, seed);
    ASSERT_EQ(found.size(), n);
    const std::size_t way = (found[1] + n - found[0]) % n;
    EXPECT_TRUE(way == 1 || way == n - 1);
    for (std::size_t k = 1; k < n; ++k) EXPECT_EQ((found[k] + n - found[k - 1]) % n, way);
  }
}

TEST(CurveOrder, TellsStepsAndTheGapBetweenTheEnds) {
  const auto found = order_along_curve({{0, 0}, {3, 0}, {1, 0}, {7, 0}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->order, (std::vector<std::size_t>{0, 2, 1, 3}));
  EXPECT_EQ(found->largest_step, 4.0);
  EXPECT_EQ(found->gap, 7.0);
}

TEST(CurveOrder, BeginsAtTheEndThatComesFirst) {
  const auto found = order_along_curve({{1, 0}, {3, 0}, {2, 0}, {0, 0}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->order, (std::vector<std::size_t>{1, 2, 0, 3}));
}

TEST(CurveOrder, OfCurvesThatMeetIsRefusedWithThePlace) {
  Row tee;
  for (int k = -5; k <= 5; ++k) tee.push_back({double(k), 0.0});
  for (int k = 1; k <= 5; ++k) tee.push_back({0.0, double(k)});
  const auto none = order_along_curve(tee);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(none.error().index, 5);
}

TEST(CurveOrder, OfFewManyAndEqualPointsIsRefused) {
  EXPECT_EQ(order_along_curve({{0, 0}, {1, 0}}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(order_along_curve(Row(20'001, Vec2{})).error().code, ErrorCode::kBadCount);
  EXPECT_EQ(order_along_curve({{0, 0}, {1, 0}, {0, 0}}).error().code, ErrorCode::kOutOfOrder);
}

/// A symmetric section with a thin end, closed form (NACA 00xx), cosine spacing: near its end both
/// sides are nearer to each other than neighbours are.
Row thin_section(int steps, double thickness) {
  Row row;
  const auto half = [&](double x) {
    return 5.0 * thickness *
           (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x -
            0.1015 * x * x * x * x);
  };
  const auto at = [&](int k) { return 0.5 - 0.5 * std::cos(3.141592653589793 * k / steps); };
  for (int k = steps; k >= 0; --k) row.push_back({at(k), half(at(k))});
  for (int k = 1; k <= steps; ++k) row.push_back({at(k), -half(at(k))});
  return row;
}

TEST(CurveOrder, OfAThinEndIsThatOfTheOutline) {
  const Row row = thin_section(40, 0.12);
  const std::size_t n = row.size();
  for (unsigned seed = 1; seed <= 10; ++seed) {
    for (const double scale : {1e-9, 1.0, 1e9}) {
      const auto found = found_order(row, seed, scale);
      ASSERT_EQ(found.size(), n) << seed;
      const std::size_t way = (found[1] + n - found[0]) % n;
      EXPECT_TRUE(way == 1 || way == n - 1);
      for (std::size_t k = 1; k < n; ++k) EXPECT_EQ((found[k] + n - found[k - 1]) % n, way);
    }
  }
}

TEST(CurveOrder, OfARowFromSideToSideIsNeverGiven) {
  // two straight sides, nearer to each other than points along them: the shortest row goes zigzag
  Row strip;
  for (int k = 0; k < 12; ++k) {
    strip.push_back({1.0 * k, 0.0});
    strip.push_back({1.0 * k + 0.5, 0.7});
  }
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto found = found_order(strip, seed);  // even indices lie on one side
    std::size_t across = 0;
    for (std::size_t k = 1; k < found.size(); ++k) across += (found[k] + found[k - 1]) % 2;
    EXPECT_LE(across, 2U);
  }
}

/// Points at random places of an ellipse, off it by normal errors; angles ascend.
Row scattered_ellipse(int count, double scatter, std::mt19937& random) {
  std::uniform_real_distribution<double> place(0.0, 2.0 * std::numbers::pi);
  std::normal_distribution<double> error(0.0, scatter);
  std::vector<double> angles;
  for (int k = 0; k < count; ++k) angles.push_back(place(random));
  std::sort(angles.begin(), angles.end());
  Row out;
  for (const double angle : angles) {
    const Vec2 e = unit_at(angle);
    out.push_back({30.0 * e.x + error(random), 10.0 * e.y + error(random)});
  }
  return out;
}

/// Near an ellipse of half axes 30 and 10: the point of it at the same angle.
Vec2 ellipse_at(Vec2 p) {
  const Vec2 e = unit_at(std::atan2(p.y / 10.0, p.x / 30.0));
  return {30.0 * e.x, 10.0 * e.y};
}

TEST(CurveOrder, OfPointsNearerThanTheyScatterIsThatOfTheirRow) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    constexpr int kCount = 600;
    constexpr double kScatter = 0.02;
    const Row row = scattered_ellipse(kCount, kScatter, random);
    const auto mixed = shuffled_indices(row.size(), seed);
    Row list;
    for (const std::size_t i : mixed) list.push_back(row[i]);
    const auto found = order_beside_row(list);
    ASSERT_TRUE(found) << seed;
    ASSERT_EQ(found->order.size(), row.size());
    // once around, and nowhere back by more than errors may shift points
    std::vector<double> way;
    for (std::size_t k = 0; k < row.size(); ++k) {
      way.push_back(k == 0 ? 0.0 : way.back() + norm(ellipse_at(row[k]) - ellipse_at(row[k - 1])));
    }
    const double around = way.back() + norm(ellipse_at(row.back()) - ellipse_at(row.front()));
    double forward = 0.0, back = 0.0;
    for (std::size_t k = 1; k < row.size(); ++k) {
      const double step =
          std::remainder(way[mixed[found->order[k]]] - way[mixed[found->order[k - 1]]], around);
      forward = std::max(forward, step);
      back = std::max(back, -step);
    }
    EXPECT_LE(std::min(forward, back), 10.0 * kScatter) << seed;
  }
}

TEST(CurveOrder, OfBothSidesOfAThinPlateIsNeverThatOfOneRow) {
  for (const int count : {12, 60, 300, 1200}) {
    Row strip;
    for (int k = 0; k < count; ++k) {
      strip.push_back({1.0 * k, 0.0});
      strip.push_back({1.0 * k + 0.5, 0.7});
    }
    const auto mixed = shuffled_indices(strip.size(), 5);
    Row list;
    for (const std::size_t i : mixed) list.push_back(strip[i]);
    const auto found = order_beside_row(list);
    if (!found) continue;
    std::size_t across = 0;
    for (std::size_t k = 1; k < found->order.size(); ++k) {
      across += (mixed[found->order[k]] + mixed[found->order[k - 1]]) % 2;
    }
    EXPECT_LE(across, 2U) << count;
  }
}

/// Cells of the distance that thins them have numbers beyond all integers.
TEST(CurveOrder, OfACloudWithPointsImmenselyFarOffIsRefusedOrFound) {
  std::mt19937 random(3);
  Row list = scattered_ellipse(200, 0.5, random);
  list.push_back({1e22, 3.0});
  list.push_back({-1e22, 4.0});
  const auto found = order_beside_row(list);
  if (found) {
    EXPECT_EQ(found->order.size(), list.size());
  } else {
    EXPECT_EQ(found.error().code, ErrorCode::kOutOfOrder);
  }
}

}  // namespace
}  // namespace obvid
