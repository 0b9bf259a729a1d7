// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/tridiagonal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid {
namespace {

TEST(Tridiagonal, SolvesTheSecondDifferenceOfASine) {
  // -m_{i-1} + 2 m_i - m_{i+1} has the eigenvectors sin(i k pi/(n+1)) with 2 - 2 cos(k pi/(n+1))
  constexpr std::size_t kSize = 40;
  const double angle = 3.0 * std::numbers::pi / double(kSize + 1);
  const double eigenvalue = 2.0 - 2.0 * std::cos(angle);
  TridiagonalSystem<double, double> system(kSize);
  system.set_first(2.0, -1.0, eigenvalue * std::sin(angle));
  for (std::size_t i = 1; i < kSize; ++i) {
    system.add(i, -1.0, 2.0, -1.0, eigenvalue * std::sin(double(i + 1) * angle));
  }
  const auto m = system.solve();
  ASSERT_EQ(m.size(), kSize);
  for (std::size_t i = 0; i < kSize; ++i) {
    EXPECT_NEAR(m[i], std::sin(double(i + 1) * angle), 1e-13) << i;
  }
}

TEST(Tridiagonal, OneEquationIsADivision) {
  TridiagonalSystem<double, double> system(1);
  system.set_first(4.0, 0.0, 3.0);
  EXPECT_EQ(system.solve().front(), 0.75);
}

}  // namespace
}  // namespace obvid
