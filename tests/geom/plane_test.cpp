// SPDX-License-Identifier: Apache-2.0
// Properties of plane geometry, of angles and of ranges: each is tried on values that RapidCheck
// draws, and shrunk to the simplest that breaks it.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/geom/vec2.h"

namespace obvid {
namespace {

constexpr double kEps = 0x1p-52;

/// Numbers with a wide range of sizes, some of them 0: m 2^e with integers |m| <= 2^20, |e| <= 30.
rc::Gen<double> sized_number() {
  return rc::gen::map(
      rc::gen::pair(rc::gen::inRange(-(1 << 20), 1 << 20), rc::gen::inRange(-30, 31)),
      [](const std::pair<int, int>& m) { return std::ldexp(m.first, m.second); });
}
double drawn_number() { return *sized_number(); }
Vec2 drawn_vector() { return {*sized_number(), *sized_number()}; }
/// Up to some hundred turns, in steps of 2^-20 rad.
double drawn_angle() { return std::ldexp(*rc::gen::inRange(-(1 << 29), 1 << 29), -20); }

RC_GTEST_PROP(Vec2, IsAComplexNumber, ()) {
  const Vec2 a = drawn_vector(), b = drawn_vector();
  const Vec2 p = complex_product(a, b);
  // (ac - bd, ad + bc): Lagrange's identity for both parts
  RC_ASSERT(std::abs(norm(p) - norm(a) * norm(b)) <= 8 * kEps * norm(a) * norm(b));
  RC_ASSERT(p == complex_product(b, a));
  RC_ASSERT(left_normal(a) == complex_product({0, 1}, a));
}

RC_GTEST_PROP(Vec2, ScalarAndCrossProductShareOutTheLengths, ()) {
  const Vec2 a = drawn_vector(), b = drawn_vector();
  const double both = norm(a) * norm(b);
  RC_ASSERT(std::abs(std::hypot(dot(a, b), cross(a, b)) - both) <= 8 * kEps * both);
  RC_ASSERT(cross(a, b) == -cross(b, a));
  RC_ASSERT(dot(a, left_normal(a)) == 0.0);
  RC_ASSERT(cross(a, left_normal(a)) == dot(a, a));
}

RC_GTEST_PROP(Vec2, TurningIsTheAngleBetweenHeadings, ()) {
  const Vec2 a = drawn_vector(), b = drawn_vector();
  RC_PRE(norm(a) > 0.0 && norm(b) > 0.0);
  const double turn = turning(a, b);
  RC_ASSERT(std::abs(turn) <= std::numbers::pi);
  RC_ASSERT(std::abs(nearest_angle(heading(b) - heading(a), turn) - turn) <= 16 * kEps);
  const Vec2 turned = complex_product(a, unit_at(turn));
  RC_ASSERT(std::abs(cross(turned, b)) <= 16 * kEps * norm(a) * norm(b));
  RC_ASSERT(dot(turned, b) > 0.0);
}

RC_GTEST_PROP(NearestAngle, MeansTheSameDirectionAtMostHalfATurnAway, ()) {
  const double theta = drawn_angle(), to = drawn_angle();
  const double near = nearest_angle(theta, to);
  RC_ASSERT(std::abs(near - to) <= std::numbers::pi * (1 + kEps) + kEps * std::abs(to));
  const double turns = (near - theta) / kFullTurn;
  RC_ASSERT(std::abs(turns - std::round(turns)) <= 1e-12);  // of some hundred turns
}

RC_GTEST_PROP(AngleRange, HoldsWhatItTookAndNoMore, ()) {
  const auto angles = *rc::gen::container<std::vector<double>>(sized_number());
  AngleRange range;
  for (const double a : angles) range.take(a);
  RC_ASSERT(range.empty() == angles.empty());
  if (angles.empty()) {
    RC_ASSERT(range.width() == 0.0);
  } else {
    const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
    RC_ASSERT(range.low == *low && range.high == *high && range.width() == *high - *low);
  }
}

RC_GTEST_PROP(Box, IsTheSmallestThatHoldsItsPoints, ()) {
  const auto count = *rc::gen::inRange(1, 20);
  Box2 box;
  Box3 space;
  std::vector<Vec2> points;
  for (int i = 0; i < count; ++i) {
    points.push_back(drawn_vector());
    box.add(points.back());
    space.add({points.back().x, 7.0, points.back().y});
  }
  const auto touches = [&](auto&& coordinate, double end) {
    return std::any_of(points.begin(), points.end(), [&](Vec2 p) { return coordinate(p) == end; });
  };
  for (const Vec2 p : points) {
    RC_ASSERT(p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y);
  }
  RC_ASSERT(touches([](Vec2 p) { return p.x; }, box.low.x));
  RC_ASSERT(touches([](Vec2 p) { return p.x; }, box.high.x));
  RC_ASSERT(touches([](Vec2 p) { return p.y; }, box.low.y));
  RC_ASSERT(touches([](Vec2 p) { return p.y; }, box.high.y));
  RC_ASSERT(space.size() == (Vec3{box.high.x - box.low.x, 0.0, box.high.y - box.low.y}));
  RC_ASSERT(space.middle().y == 7.0);
}

ValueRange drawn_range(double most) {
  const double low = *rc::gen::inRange(-10000, 10001) * 1e-3;
  return {low, low + *rc::gen::inRange(0, 1000) * 1e-3 * most};
}

/// Whether a heading means one of a range.
bool means(const ValueRange& range, double theta) {
  const double near = turned_to(range, theta);
  return near >= range.low - 1e-12 && near <= range.high + 1e-12;
}

RC_GTEST_PROP(CommonHeadings, AreThoseThatBothRangesMean, ()) {
  const ValueRange a = drawn_range(kFullTurn), b = drawn_range(kFullTurn);
  const auto both = common_headings(a, b);
  const double theta = *rc::gen::inRange(0, 100000) * 1e-5 * kFullTurn;
  if (!both) return;  // two ranges apart from each other: not one
  const bool close_to_an_end = std::min({std::abs(nearest_angle(theta, a.low) - a.low),
                                         std::abs(nearest_angle(theta, a.high) - a.high),
                                         std::abs(nearest_angle(theta, b.low) - b.low),
                                         std::abs(nearest_angle(theta, b.high) - b.high)}) < 1e-9;
  RC_PRE(!close_to_an_end);
  RC_ASSERT((means(a, theta) && means(b, theta)) == (!both->empty() && means(*both, theta)));
}

TEST(CommonHeadings, AreNoneWhereTwoRangesAreLeft) {
  // a from 0 to 3.5, b from 3 to 3 + 4: both 3 to 3.5, and 2 pi to 7 = 0 to 0.717
  EXPECT_FALSE(common_headings({0.0, 3.5}, {3.0, 7.0}).has_value());
}

RC_GTEST_PROP(CurvaturesOfRadii, AreTheReciprocalsOfEachRadius, ()) {
  const double one = drawn_number(), other = drawn_number();
  RC_PRE(one != 0.0 && other != 0.0 && (one > 0.0) == (other > 0.0));
  const ValueRange radii{std::min(one, other), std::max(one, other)};
  const auto found = curvatures_of_radii(radii);
  RC_ASSERT(found.has_value());
  RC_ASSERT(found->low == 1.0 / radii.high && found->high == 1.0 / radii.low);
  // an open end is the straight line, on the side that the other end says
  const double endless = std::numeric_limits<double>::infinity();
  const auto open =
      one > 0.0 ? curvatures_of_radii({one, endless}) : curvatures_of_radii({-endless, one});
  RC_ASSERT(open.has_value());
  RC_ASSERT((one > 0.0 ? open->low : open->high) == 0.0);
  RC_ASSERT((one > 0.0 ? open->high : open->low) == 1.0 / one);
}

TEST(CurvaturesOfRadii, AreNoneOfTwoSigns) {
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(curvatures_of_radii({-2.0, 3.0}).has_value());
  EXPECT_FALSE(curvatures_of_radii({-endless, endless}).has_value());
  EXPECT_FALSE(curvatures_of_radii({3.0, 2.0}).has_value());
}

}  // namespace
}  // namespace obvid
