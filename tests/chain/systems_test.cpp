// SPDX-License-Identifier: Apache-2.0
// The linear systems of both solvers against the equations themselves, written out in full.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "newton_system.h"
#include "slope_system.h"

namespace obvid::chain_detail {
namespace {

using Row = std::vector<double>;

/// Largest residual of A x = b, in the size of what is summed.
double residual(const std::vector<Row>& a, const Row& x, const Row& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    double sum = -b[i], size = std::abs(b[i]);
    for (std::size_t j = 0; j < a.size(); ++j) {
      sum += a[i][j] * x[j];
      size = std::max(size, std::abs(a[i][j] * x[j]));
    }
    worst = std::max(worst, size > 0.0 ? std::abs(sum) / size : 0.0);
  }
  return worst;
}

class Systems : public testing::Test {
 protected:
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(generator_); }
  /// Sizes of unknowns as different as those of dense and coarse parts of one series.
  double scale() { return std::pow(10.0, 3.0 * number()); }

 private:
  std::mt19937_64 generator_{20261127};
};

TEST_F(Systems, NewtonsDirectionSolvesItsEquationsWithSlackAndFixedVariables) {
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t nodes = 1 + static_cast<std::size_t>(trial) % 9, n = 2 * nodes;
    const bool slack = trial % 2 == 1;
    Row unit(n + 1);
    for (double& u : unit) u = scale();
    // a sum of squares of what neighbours have in common: positive definite
    std::vector<Row> a(n + 1, Row(n + 1, 0.0));
    for (std::size_t i = 0; i <= n; ++i) a[i][i] = 0.1;
    for (std::size_t k = 0; k + 1 < nodes + (nodes == 1 ? 1 : 0); ++k) {
      for (int square = 0; square < 3; ++square) {
        Row g(n + 1, 0.0);
        for (std::size_t i = 2 * k; i < std::min(n, 2 * k + 4); ++i) g[i] = number();
        g[n] = slack ? number() : 0.0;
        for (std::size_t i = 0; i <= n; ++i) {
          for (std::size_t j = 0; j <= n; ++j) a[i][j] += g[i] * g[j];
        }
      }
    }
    for (std::size_t i = 0; i <= n; ++i) {
      for (std::size_t j = 0; j <= n; ++j) a[i][j] *= unit[i] * unit[j];
    }
    Row gradient(n + 1);
    for (std::size_t i = 0; i <= n; ++i) gradient[i] = number() * unit[i];
    NewtonSystem system;
    system.reset(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::size_t i = 2 * k;
      NewtonSystem::Block& b = system[k];
      b = {a[i][i], a[i + 1][i], a[i + 1][i + 1], 0.0,     0.0,        0.0,
           0.0,     gradient[i], gradient[i + 1], a[i][n], a[i + 1][n]};
      if (k + 1 == nodes) continue;
      b.o00 = a[i][i + 2];
      b.o01 = a[i][i + 3];
      b.o10 = a[i + 1][i + 2];
      b.o11 = a[i + 1][i + 3];
    }
    system.slack_hessian = a[n][n];
    system.slack_gradient = slack ? gradient[n] : 0.0;
    const std::size_t fixed =
        static_cast<std::size_t>(trial) % (2 * n);  // none in half of the trials
    if (fixed < n) {
      system.fix(fixed / 2, static_cast<int>(fixed % 2));
      for (std::size_t j = 0; j <= n; ++j) a[fixed][j] = a[j][fixed] = 0.0;
      a[fixed][fixed] = 1.0;
      gradient[fixed] = 0.0;
    }
    Row x;
    double s = 0.0;
    system.solve(x, s, slack);
    const double decrement = system.decrement(x, s);
    x.push_back(s);
    Row right(n + 1);
    double decrease = 0.0;
    for (std::size_t i = 0; i <= n; ++i) {
      right[i] = -gradient[i];
      decrease -= gradient[i] * x[i];
    }
    if (!slack) {  // the border takes no part
      for (std::size_t i = 0; i <= n; ++i) a[i][n] = a[n][i] = 0.0;
      a[n][n] = 1.0;
      right[n] = 0.0;
      EXPECT_EQ(s, 0.0);
    }
    EXPECT_LT(residual(a, x, right), 1e-11) << trial;
    EXPECT_NEAR(decrement, decrease, 1e-12 * (1.0 + std::abs(decrease))) << trial;
    EXPECT_GE(decrement, 0.0) << trial;
    EXPECT_EQ(fixed < n ? x[fixed] : 0.0, 0.0);
  }
}

TEST_F(Systems, SlopesAreSolvedForInTheBandWhateverRowsAreExchanged) {
  constexpr std::size_t kBlock = SlopeSystem::kBlock;
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t nodes = 1 + static_cast<std::size_t>(trial) % 8, n = kBlock * nodes;
    SlopeSystem system;
    system.reset(nodes);
    std::vector<Row> a(n, Row(n, 0.0));
    Row right(n);
    for (std::size_t i = 0; i < n; ++i) {
      right[i] = system.right(i) = number();
      for (std::size_t j = i; j < std::min(n, kBlock * (i / kBlock + 2)); ++j) {
        // multipliers have no squares: rows must be exchanged
        const bool multipliers = i % kBlock == 2 && j % kBlock == 2;
        a[i][j] = a[j][i] = multipliers ? 0.0 : number();
        system.at(i, j) = system.at(j, i) = a[i][j];
      }
    }
    const std::size_t fixed = static_cast<std::size_t>(trial) % (2 * n);
    if (fixed < n) {
      system.fix(fixed);
      for (std::size_t j = 0; j < n; ++j) a[fixed][j] = a[j][fixed] = 0.0;
      a[fixed][fixed] = 1.0;
      right[fixed] = 0.0;
    }
    if (!system.solve()) continue;  // one node alone may be singular
    EXPECT_LT(residual(a, system.solution(), right), 1e-9) << trial;
    EXPECT_EQ(fixed < n ? system.solution()[fixed] : 0.0, 0.0);
  }
}

TEST_F(Systems, AMatrixWithoutAPivotIsSaidToHaveNone) {
  SlopeSystem system;
  system.reset(2);
  for (std::size_t i = 0; i < system.size(); ++i) system.right(i) = 1.0;
  EXPECT_FALSE(system.solve());
}

}  // namespace
}  // namespace obvid::chain_detail
