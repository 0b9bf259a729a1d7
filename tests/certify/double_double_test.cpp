// SPDX-License-Identifier: Apache-2.0
#include "double_double.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>

namespace obvid {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

Fraction exactly(double x) { return Fraction(x); }
Fraction exactly(DoubleDouble x) { return Fraction(x.hi) + Fraction(x.lo); }

/// |found - truth| / |truth|
double relative_error(const DoubleDouble& found, const Fraction& truth) {
  if (truth == 0) return exactly(found) == 0 ? 0.0 : HUGE_VAL;
  return std::abs(static_cast<double>(Fraction((exactly(found) - truth) / truth)));
}

class DoubleDoubleTest : public ::testing::Test {
 protected:
  double wide() { return std::ldexp(unit_(rng_), exponent_(rng_)); }
  DoubleDouble number() { return two_sum(wide(), std::ldexp(unit_(rng_), -60)); }
  /// Close to -x, so that a sum cancels.
  DoubleDouble opposite(const DoubleDouble& x) {
    return two_sum(-x.hi, std::ldexp(unit_(rng_), std::ilogb(x.hi) - 53) - x.lo);
  }

 private:
  std::mt19937_64 rng_{42};
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::uniform_int_distribution<int> exponent_{-30, 30};
};

TEST_F(DoubleDoubleTest, SumsAndProductsOfDoublesAreExact) {
  for (int i = 0; i < 2000; ++i) {
    const double a = wide(), b = wide();
    EXPECT_EQ(exactly(two_sum(a, b)), exactly(a) + exactly(b));
    EXPECT_EQ(exactly(two_product(a, b)), exactly(a) * exactly(b));
    const DoubleDouble ordered =
        std::abs(a) >= std::abs(b) ? quick_two_sum(a, b) : quick_two_sum(b, a);
    EXPECT_EQ(exactly(ordered), exactly(a) + exactly(b));
  }
}

TEST_F(DoubleDoubleTest, EveryOperationKeepsItsErrorBound) {
  double worst = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const DoubleDouble a = number();
    const DoubleDouble b = i % 2 == 0 ? number() : opposite(a);
    worst = std::max(worst, relative_error(a + b, exactly(a) + exactly(b)));
    worst = std::max(worst, relative_error(a - b, exactly(a) - exactly(b)));
    worst = std::max(worst, relative_error(a * b, exactly(a) * exactly(b)));
    worst = std::max(worst, relative_error(a * (i + 1), exactly(a) * (i + 1)));
  }
  EXPECT_LE(worst, kDoubleDoubleRoundoff);
  EXPECT_GT(worst, 0.0);
}

}  // namespace
}  // namespace obvid
