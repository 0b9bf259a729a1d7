// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/halving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace obvid {
namespace {

TEST(EndOfCondition, LiesBetweenNeighbouringDoubles) {
  const auto end = end_of_condition(1.0, 2.0, [](double x) { return x * x < 2.0; });
  EXPECT_LT(end.holds * end.holds, 2.0);
  EXPECT_GE(end.fails * end.fails, 2.0);
  EXPECT_EQ(std::nextafter(end.holds, 2.0), end.fails);
}

TEST(EndOfCondition, MayBeLookedForDownwards) {
  const auto end = end_of_condition(5.0, -3.0, [](double x) { return x > 0.7; });
  EXPECT_EQ(end.fails, 0.7);
  EXPECT_EQ(end.holds, std::nextafter(0.7, 1.0));
}

TEST(EndOfCondition, IsHalvedAsOftenAsAsked) {
  int calls = 0;
  const auto end = end_of_condition(
      0.0, 1.0, [&](double x) { return ++calls, x <= 0.3; }, 4);
  EXPECT_EQ(calls, 4);
  EXPECT_EQ(end.holds, 0.25);
  EXPECT_EQ(end.fails, 0.3125);
  EXPECT_EQ(end.middle(), 0.28125);
}

TEST(EndOfCondition, StaysBetweenTheEndsThatAreGiven) {
  const auto all = end_of_condition(0.0, 1.0, [](double) { return true; });
  EXPECT_EQ(all.fails, 1.0);
  EXPECT_EQ(all.holds, std::nextafter(1.0, 0.0));
  const auto none = end_of_condition(2.0, 2.0, [](double) { return false; });
  EXPECT_EQ(none.holds, 2.0);
}

}  // namespace
}  // namespace obvid
