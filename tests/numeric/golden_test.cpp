// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/golden.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

TEST(HighestPlace, IsFoundAsWellAsTheValuesTell) {
  // flat tops to the root of a rounding, sharp ones to the last digits, and tops at an end
  EXPECT_NEAR(highest_place(0.0, 1.0, [](double x) { return -(x - 0.3) * (x - 0.3); }), 0.3, 2e-8);
  EXPECT_NEAR(highest_place(0.0, 3.0, [](double x) { return std::sin(x); }), std::acos(0.0), 2e-8);
  EXPECT_NEAR(highest_place(-1.0, 2.0, [](double x) { return -std::abs(x - 0.7); }), 0.7, 1e-15);
  EXPECT_NEAR(highest_place(2.0, 5.0, [](double x) { return -x; }), 2.0, 1e-14);
  EXPECT_NEAR(highest_place(1e9, 3e9, [](double x) { return -std::abs(x - 2e9); }), 2e9, 1e-6);
}

TEST(HighestPlace, EndsWhereNothingRises) {
  const double x = highest_place(0.0, 1.0, [](double) { return 1.0; });
  EXPECT_GE(x, 0.0);
  EXPECT_LE(x, 1.0);
  EXPECT_EQ(highest_place(4.0, 4.0, [](double) { return 0.0; }), 4.0);
}

TEST(HighestPlace, IsLookedForNoCloserThanAsked) {
  int calls = 0;
  const auto tent = [&](double x) { return ++calls, -std::abs(x - 0.3); };
  EXPECT_NEAR(highest_place(0.0, 1.0, tent, 1e-3), 0.3, 1e-3);
  EXPECT_LT(calls, 20);  // 0.618^15 < 1e-3, one call for each section
}

TEST(LowestPlace, IsTheHighestOfTheOpposite) {
  EXPECT_NEAR(lowest_place(-1.0, 2.0, [](double x) { return std::abs(x - 0.7); }), 0.7, 1e-15);
}

}  // namespace
}  // namespace obvid
