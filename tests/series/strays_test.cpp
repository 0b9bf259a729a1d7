// SPDX-License-Identifier: Apache-2.0
// Points of known curves in no order, with some that belong to none.
#include "obvid/series/internal/strays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <vector>

namespace obvid {
namespace {

/// A circle of radius 50 with normal errors, and points that stray, in no order.
struct Cloud {
  std::vector<Vec2> points;
  std::set<std::size_t> strays;
};

Cloud circle_with(const std::vector<Vec2>& strays, int count, unsigned seed, double part = 1.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, 0.01);
  std::vector<std::pair<Vec2, bool>> all;
  for (int k = 0; k < count; ++k) {
    const double angle = part * 2.0 * std::numbers::pi * k / count;
    all.emplace_back((50.0 + error(random)) * unit_at(angle), false);
  }
  for (const Vec2 p : strays) all.emplace_back(p, true);
  for (std::size_t k = all.size() - 1; k > 0; --k) std::swap(all[k], all[random() % (k + 1)]);
  Cloud out;
  for (const auto& [p, is_stray] : all) {
    if (is_stray) out.strays.insert(out.points.size());
    out.points.push_back(p);
  }
  return out;
}

std::set<std::size_t> named(const OrderBesideStrays& found) {
  std::set<std::size_t> out;
  for (const Outlier& one : found.strays.points) out.insert(one.index);
  return out;
}

TEST(Strays, AreFoundWhereverTheyLie) {
  const std::vector<std::vector<Vec2>> kinds = {{{0, 0}},
                                                {{-8.9, 50.7}},
                                                {{0, 48.2}},
                                                {{200, -300}},
                                                {{-70, 1}, {1, 71}},
                                                {{30, 30}, {30.5, 30.5}},
                                                {{-60, 1}, {-60, 2}, {-60, 3}}};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    for (const auto& strays : kinds) {
      for (const double part : {1.0, 0.8}) {
        const Cloud cloud = circle_with(strays, 300, seed, part);
        const auto whole = order_along_curve(cloud.points);
        if (whole) continue;  // a stray that hangs on an end lets the others have their order
        const auto found = order_beside_strays(cloud.points);
        ASSERT_TRUE(found) << strays.front().x << ' ' << strays.front().y << ' ' << part;
        EXPECT_EQ(named(*found), cloud.strays);
        ASSERT_EQ(found->order.order.size(), 300U);
        for (std::size_t k = 1; k < 300; ++k) {
          const Vec2 step =
              cloud.points[found->order.order[k]] - cloud.points[found->order.order[k - 1]];
          EXPECT_LT(norm(step), 1.1);
        }
      }
    }
  }
}

TEST(Strays, AtAnEndOfARowAreNamedWhereTheRowGoesOnWithoutThem) {
  // steps of 0.42; the row begins at (50, 0) and comes from above, errors of 0.01
  const std::vector<std::vector<Vec2>> kinds = {
      {{50.5, -0.3}}, {{49.5, -0.4}}, {{50, -0.4}, {51, -0.6}}, {{53, -3}}};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      const Cloud cloud = circle_with(kinds[kind], 300, seed, 0.4);
      const auto whole = order_along_curve(cloud.points);
      ASSERT_TRUE(whole);
      const auto found = without_end_strays(cloud.points, *whole);
      ASSERT_TRUE(found) << kind << ' ' << seed;
      // (50, -0.4) is where the row goes on to: what is behind it strays alone
      EXPECT_EQ(named(*found).size(), 1U) << kind;
      EXPECT_EQ(found->order.order.size(), cloud.points.size() - 1);
      const Vec2 stray = cloud.points[found->strays.points.front().index];
      EXPECT_EQ(stray, kinds[kind].back());
      EXPECT_NEAR(found->strays.points.front().off, std::abs(norm(stray) - 50.0),
                  0.1 + 0.2 * std::abs(norm(stray) - 50.0));
    }
  }
}

TEST(Strays, AtAnEndAreNoneOfRowsThatGoOn) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Cloud cloud = circle_with({}, 300, seed, 0.4);
    const auto whole = order_along_curve(cloud.points);
    ASSERT_TRUE(whole);
    EXPECT_FALSE(without_end_strays(cloud.points, *whole));
  }
  // a spiral that winds up towards its end, and rows without errors
  std::vector<Vec2> spiral, parabola, coarse;
  for (int k = 0; k < 120; ++k) {
    const double t = 0.05 * k;
    spiral.push_back(20.0 * std::exp(-0.25 * t) * unit_at(t));
    parabola.push_back({0.1 * k - 6.0, std::pow(0.1 * k - 6.0, 2)});
    coarse.push_back({std::round(100.0 * k) / 100.0, std::round(10.0 * std::sin(0.1 * k)) / 10.0});
  }
  for (const auto& row : {spiral, parabola, coarse}) {
    const auto whole = order_along_curve(row);
    ASSERT_TRUE(whole);
    EXPECT_FALSE(without_end_strays(row, *whole));
  }
}

TEST(Strays, AtAnEndAreNoneWhereThePointBehindMayBeTheWrongOne) {
  // the second point lies off the circle, by less than an end has to (a quarter of a step)
  for (const double off : {0.15, 0.2, 0.24}) {
    std::vector<Vec2> row;
    for (int k = 0; k < 120; ++k) row.push_back((k == 1 ? 50.0 + off : 50.0) * unit_at(0.02 * k));
    const auto whole = order_along_curve(row);
    ASSERT_TRUE(whole);
    EXPECT_FALSE(without_end_strays(row, *whole)) << off;
  }
}

TEST(Strays, AreSoFarOffAsTheyAre) {
  const Cloud cloud = circle_with({{0, 0}}, 300, 7);
  const auto found = order_beside_strays(cloud.points);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->strays.points.size(), 1U);
  EXPECT_NEAR(found->strays.points.front().off, 50.0, 0.1);
  EXPECT_NEAR(found->strays.deviation, 0.01, 0.003);
}

TEST(Strays, AreNoneWhereCurvesMeetOrPointsScatter) {
  std::vector<Vec2> tee;
  for (int k = -30; k <= 30; ++k) tee.push_back({static_cast<double>(k), 0.0});
  for (int k = 1; k <= 30; ++k) tee.push_back({0.0, static_cast<double>(k)});
  EXPECT_FALSE(order_beside_strays(tee));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 10.0);
  std::vector<Vec2> cloud;
  for (int k = 0; k < 200; ++k) cloud.push_back({place(random), place(random)});
  EXPECT_FALSE(order_beside_strays(cloud));
  EXPECT_FALSE(order_beside_strays({{0, 0}, {1, 0}, {2, 0}, {1, 1}}));
}

}  // namespace
}  // namespace obvid
