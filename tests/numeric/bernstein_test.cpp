// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/bernstein.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

template <std::size_t Count>
double value(const std::array<double, Count>& c, double t) {
  double sum = 0.0;
  for (std::size_t j = 0; j < Count; ++j) {
    sum += c[j] * std::pow(t, double(j)) * std::pow(1.0 - t, double(Count - 1 - j));
  }
  return sum;
}

TEST(Bernstein, BinomialsAreThoseOfPascal) {
  EXPECT_EQ(binomial(4, 2), 6.0);
  EXPECT_EQ(binomial(20, 10), 184756.0);
  EXPECT_EQ(binomial(44, 22), 2104098963720.0);
  EXPECT_EQ(binomial(3, -1), 0.0);
  EXPECT_EQ(binomial(3, 4), 0.0);
}

TEST(Bernstein, ProductsAreTheProductsOfTheValues) {
  const std::array<double, 3> a = {1.0, -2.0, 0.5};
  const std::array<double, 4> b = {0.25, 3.0, -1.0, 2.0};
  std::array<double, 6> sum{};
  add_product(sum, a, b);
  std::array<double, 6> difference{};
  subtract_product(difference, a, b);
  for (const double t : {0.0, 0.3, 0.75, 1.0}) {
    EXPECT_NEAR(value(sum, t), value(a, t) * value(b, t), 1e-14);
    EXPECT_NEAR(value(difference, t), -value(a, t) * value(b, t), 1e-14);
  }
}

TEST(Bernstein, PartialDerivativesGiveTheDerivativeAndEulersIdentity) {
  // p = t^3 has scaled coefficients (0, 0, 0, 1).
  const std::array<double, 4> cube = {0.0, 0.0, 0.0, 1.0};
  const std::array<double, 4> other = {2.0, -1.0, 4.0, 0.5};
  for (const double t : {0.0, 0.25, 0.6, 1.0}) {
    EXPECT_NEAR(value(partial_t(cube), t) - value(partial_s(cube), t), 3.0 * t * t, 1e-15);
    EXPECT_NEAR(t * value(partial_t(other), t) + (1.0 - t) * value(partial_s(other), t),
                3.0 * value(other, t), 1e-14);
    EXPECT_NEAR(value(partial_t(other, 5), t), 5.0 * value(partial_t(other), t), 1e-14);
  }
}

}  // namespace
}  // namespace obvid
