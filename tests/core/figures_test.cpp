// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace obvid {
namespace {

TEST(Figures, HaveSoManyDigits) {
  EXPECT_EQ(significant(3.14159265), "3.1416");
  EXPECT_EQ(significant(1234567.0, 3), "1234567");
  EXPECT_EQ(significant(0.00002345, 3), "2.35e-05");  // the double is above the tie
  EXPECT_EQ(significant(-0.5, 3), "-0.500");
  EXPECT_EQ(significant(std::nan("")), "-");
  EXPECT_EQ(significant(HUGE_VAL), "inf");
}

TEST(Figures, WhatFollowsTheNamedOnesIsCounted) {
  EXPECT_EQ(and_more(8, 8), "");
  EXPECT_EQ(and_more(3, 8), "");
  EXPECT_EQ(and_more(9, 8), " and 1 more");
  EXPECT_EQ(and_more(20, 8), " and 12 more");
}

TEST(Figures, LimitsAreNeverPrintedAboveThemselvesAndHardlyBelow) {
  for (double limit = 1.2345678e-12; limit < 1e9; limit *= 1.37) {
    for (const int digits : {2, 3, 5}) {
      const double printed = std::stod(significant_below(limit, digits));
      EXPECT_LT(printed, limit);
      EXPECT_GE(printed, limit * (1.0 - 2.0 * std::pow(10.0, 1 - digits)));
    }
  }
  EXPECT_EQ(significant_below(0.08166566, 6), "0.0816656");
  EXPECT_EQ(significant_below(3.0, 6), "2.99999");
  EXPECT_EQ(significant_below(HUGE_VAL, 6), "inf");
}

TEST(Figures, BoundsAreNeverPrintedBelowThemselvesAndHardlyAbove) {
  for (double bound = 1.2345678e-12; bound < 1e9; bound *= 1.37) {
    for (const int digits : {2, 3, 5}) {
      const double printed = std::stod(significant_above(bound, digits));
      EXPECT_GE(printed, bound);
      EXPECT_LE(printed, bound * (1.0 + 2.0 * std::pow(10.0, 1 - digits)));
    }
  }
  EXPECT_EQ(significant_above(0.25, 3), "0.250");
  EXPECT_EQ(significant_above(0.99991, 3), "1.000");
  EXPECT_EQ(significant_above(115790.1, 2), "115791");
  EXPECT_EQ(significant_above(1.001e-7, 3), "1.01e-07");
  EXPECT_EQ(significant_above(0.0, 3), "0");
}

}  // namespace
}  // namespace obvid
