// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/gauss.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

template <std::size_t N>
void expect_exact() {
  for (int degree = 0; degree < 2 * static_cast<int>(N); ++degree) {
    const double found =
        gauss_integral<N>(-1.0, 2.0, [&](double x) { return std::pow(x, degree); });
    const double exact = (std::pow(2.0, degree + 1) - std::pow(-1.0, degree + 1)) / (degree + 1);
    EXPECT_NEAR(found, exact, 1e-14 * std::pow(2.0, degree + 1)) << N << " " << degree;
  }
}

TEST(GaussIntegral, IsExactForPolynomialsBelowTwiceItsPoints) {
  expect_exact<4>();
  expect_exact<8>();
}

TEST(GaussIntegral, LeavesTheKnownErrorOfTheFirstOtherPolynomial) {
  // 2^(2n+1) (n!)^4 / ((2n+1) ((2n)!)^2) for x^(2n) on [-1, 1]
  const auto error = [](int n) {
    const double f = std::tgamma(n + 1.0), g = std::tgamma(2.0 * n + 1.0);
    return std::pow(2.0, 2 * n + 1) * f * f * f * f / ((2 * n + 1) * g * g);
  };
  const double four = gauss_integral<4>(-1.0, 1.0, [](double x) { return std::pow(x, 8); });
  EXPECT_NEAR(2.0 / 9 - four, error(4), 1e-15);
  const double eight = gauss_integral<8>(-1.0, 1.0, [](double x) { return std::pow(x, 16); });
  EXPECT_NEAR(2.0 / 17 - eight, error(8), 1e-15);
}

}  // namespace
}  // namespace obvid
