// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/wide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace obvid::numeric {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// A number with all its bits in use, and exactly what it is.
struct Sample {
  Wide wide;
  Rational exact;
};

class WideTest : public testing::Test {
 protected:
  double number() { return std::ldexp(unit_(random_), exponent_(random_)); }
  Sample sample() {
    const double high = number(), low = std::ldexp(unit_(random_), std::ilogb(high) - 55);
    return {Wide(high) + Wide(low), Rational(high) + Rational(low)};
  }

 private:
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::uniform_int_distribution<int> exponent_{-40, 40};
};

/// What a number is: the double nearest to it, and what that leaves, as often as it takes.
Rational value_of(Wide x) {
  Rational out = 0;
  for (int k = 0; k < 4; ++k) {
    const auto part = static_cast<double>(x);
    out += Rational(part);
    x -= part;
  }
  return out;
}

double relative_error(Wide found, const Rational& truth) {
  if (truth == 0) return static_cast<double>(found) == 0.0 ? 0.0 : HUGE_VAL;
  return std::abs(static_cast<double>(Rational((value_of(found) - truth) / truth)));
}

TEST_F(WideTest, HoldsEveryWholeNumberOf64Bits) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 1000; ++k) {
    const auto value = static_cast<std::int64_t>(random()) >> (k % 60);
    EXPECT_EQ(value_of(Wide::whole(value)), Rational(value)) << value;
  }
  for (const std::int64_t value : {INT64_MIN, INT64_MIN + 1, INT64_MAX, std::int64_t{0}}) {
    EXPECT_EQ(value_of(Wide::whole(value)), Rational(value)) << value;
  }
}

TEST_F(WideTest, EveryOperationKeepsItsErrorBound) {
  constexpr double kQuotient = 15.1 * kUnitRoundoff * kUnitRoundoff;
  double worst = 0.0, worst_quotient = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Sample a = sample(), b = sample();
    const double d = number();
    worst = std::max({worst, relative_error(a.wide + b.wide, a.exact + b.exact),
                      relative_error(a.wide - b.wide, a.exact - b.exact),
                      relative_error(a.wide * b.wide, a.exact * b.exact),
                      relative_error(a.wide * d, a.exact * Rational(d))});
    worst_quotient =
        std::max(worst_quotient, relative_error(a.wide / b.wide, Rational(a.exact / b.exact)));
  }
  EXPECT_LE(worst, kDoubleDoubleRoundoff);
  EXPECT_LE(worst_quotient, kQuotient);
  EXPECT_GT(worst_quotient, 0.0);
}

TEST_F(WideTest, OrderAndAbsoluteValueSeeTheLastBit) {
  const Wide one(1.0), more = one + Wide(0x1p-80), less = one - Wide(0x1p-80);
  EXPECT_TRUE(less < one && one < more && more > less);
  EXPECT_FALSE(one < one);
  EXPECT_FALSE(abs(-more) < more || more < abs(-more));
}

}  // namespace
}  // namespace obvid::numeric
