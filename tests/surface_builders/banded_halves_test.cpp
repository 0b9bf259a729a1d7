// SPDX-License-Identifier: Apache-2.0
#include "banded_halves.h"

#include <gtest/gtest.h>

#include <cmath>

namespace obvid {
namespace {

/// Second differences with ends held: right sides of 1 have the parabola i (n + 1 - i) / 2. The
/// band may be wider than the entries are.
TEST(BandedHalves, SolveSecondDifferences) {
  for (const std::size_t band : {1u, 2u, 7u, 40u}) {
    for (std::size_t n = 1; n <= 45; ++n) {
      BandedCholesky matrix(n, band);
      for (std::size_t i = 0; i < n; ++i) {
        matrix.at(i, i) = 2.0;
        if (i + 1 < n) matrix.at(i, i + 1) = -1.0;
      }
      BandedHalves halves(matrix);
      const auto factored = halves.factor({});
      ASSERT_TRUE(factored && *factored);
      const std::vector<double> x = halves.solve(std::vector<double>(n, 1.0));
      ASSERT_EQ(x.size(), n);
      for (std::size_t i = 0; i < n; ++i) {
        const double place = static_cast<double>(i + 1), all = static_cast<double>(n + 1);
        EXPECT_NEAR(x[i], place * (all - place) / 2.0, 1e-11 * all * all) << n << " " << band;
      }
    }
  }
}

TEST(BandedHalves, SayWhereAMatrixIsNotPositive) {
  for (const std::size_t bad : {0u, 7u, 15u, 29u}) {
    BandedCholesky matrix(30, 2);
    for (std::size_t i = 0; i < 30; ++i) matrix.at(i, i) = i == bad ? -1.0 : 1.0;
    const auto factored = BandedHalves(matrix).factor({});
    ASSERT_TRUE(factored);
    EXPECT_FALSE(*factored) << bad;
  }
}

TEST(BandedHalves, AreCancelled) {
  BandedCholesky matrix(300, 2);
  for (std::size_t i = 0; i < 300; ++i) matrix.at(i, i) = 1.0;
  const auto factored = BandedHalves(matrix).factor({{}, [] { return true; }});
  ASSERT_FALSE(factored);
  EXPECT_EQ(factored.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace obvid
