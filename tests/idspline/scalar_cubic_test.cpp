// SPDX-License-Identifier: Apache-2.0
#include "obvid/idspline/internal/scalar_cubic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "polynomial.h"

namespace obvid {
namespace {

const std::vector<double> kNodes = {-1.0, -0.4, 0.0, 0.3, 1.1, 1.4, 2.0};

std::vector<double> values_of(const Polynomial& p) {
  std::vector<double> out;
  for (const double x : kNodes) out.push_back(p.at(x));
  return out;
}

std::vector<double> wild_values() { return {1.0, -0.3, 0.7, 2.0, -1.0, 0.4, 0.9}; }

void expect_same(const ScalarCubic& s, const Polynomial& p) {
  for (double x = -1.0; x <= 2.0; x += 0.125) {
    EXPECT_NEAR(evaluate(s, x).value, p.at(x), 1e-14) << x;
    EXPECT_NEAR(evaluate(s, x).d1, p.at(x, 1), 1e-13) << x;
  }
  EXPECT_NEAR(integral(s, -0.9, 1.7), p.integral(-0.9, 1.7), 1e-14);
  EXPECT_NEAR(integral(s, -1.0, 2.0), p.integral(-1.0, 2.0), 1e-14);
}

TEST(ScalarCubic, GlobalFormsReproduceCubicsAndTheLocalOneParabolas) {
  const Polynomial p{{0.4, -0.3, 0.2, 0.15}};
  expect_same(*global_cubic_by_slopes(kNodes, values_of(p)), p);
  expect_same(*global_cubic_by_seconds(kNodes, values_of(p)), p);
  expect_same(*local_cubic(kNodes, values_of(p.cut(2))), p.cut(2));
}

TEST(ScalarCubic, SlopesAtEqualStepsAreThePublishedOnes) {
  // [004], formula (13)
  const std::vector<double> x = {0.0, 0.5, 1.0, 1.5}, f = {1.0, 3.0, 2.0, 7.0};
  const auto s = local_cubic(x, f);
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(s->slopes[0], 4.0 * f[1] - f[2] - 3.0 * f[0]);
  EXPECT_DOUBLE_EQ(s->slopes[1], f[2] - f[0]);
  EXPECT_DOUBLE_EQ(s->slopes[2], f[3] - f[1]);
  EXPECT_DOUBLE_EQ(s->slopes[3], 3.0 * f[3] + f[1] - 4.0 * f[2]);
}

TEST(ScalarCubic, BothGlobalFormsAreTheSameSplineForTheSameEnds) {
  const auto a = global_cubic_by_seconds(kNodes, wild_values(), {0.7, -2.0});
  ASSERT_TRUE(a);
  const auto b =
      global_cubic_by_slopes(kNodes, wild_values(), {a->slopes.front(), a->slopes.back()});
  ASSERT_TRUE(b);
  for (std::size_t i = 0; i < kNodes.size(); ++i) EXPECT_NEAR(a->slopes[i], b->slopes[i], 1e-12);
  EXPECT_NEAR(evaluate(*a, -1.0).d2, 0.7, 1e-12);
  EXPECT_NEAR(evaluate(*a, 2.0).d2, -2.0, 1e-12);
}

TEST(ScalarCubic, GlobalSecondDerivativesAreContinuousAndLocalOnesAreNot) {
  const auto jump = [](const ScalarCubic& s) {
    double largest = 0.0;
    for (std::size_t i = 1; i + 1 < kNodes.size(); ++i) {
      largest = std::max(largest, std::abs(evaluate(cell(s, i), kNodes[i]).d2 -
                                           evaluate(cell(s, i - 1), kNodes[i]).d2));
    }
    return largest;
  };
  EXPECT_LT(jump(*global_cubic_by_slopes(kNodes, wild_values())), 1e-11);
  EXPECT_LT(jump(*global_cubic_by_seconds(kNodes, wild_values())), 1e-11);
  EXPECT_GT(jump(*local_cubic(kNodes, wild_values())), 1.0);
}

TEST(ScalarCubic, APeriodicOneGoesOnWithTwoDerivativesAtEachNode) {
  for (std::size_t cells = 1; cells <= 6; ++cells) {
    const auto end = static_cast<std::ptrdiff_t>(cells) + 1;
    const std::vector<double> wild = wild_values();
    const std::vector<double> nodes(kNodes.begin(), kNodes.begin() + end);
    std::vector<double> values(wild.begin(), wild.begin() + end);
    values.back() = values.front();
    const auto s = periodic_cubic(nodes, values);
    ASSERT_TRUE(s);
    for (std::size_t i = 0; i < cells; ++i) {
      const CellPolynomial before = cell(*s, (i + cells - 1) % cells), after = cell(*s, i);
      const ScalarJet a = evaluate(before, i == 0 ? nodes.back() : nodes[i]),
                      b = evaluate(after, nodes[i]);
      EXPECT_NEAR(b.value, values[i], 1e-14);
      EXPECT_NEAR(a.value, b.value, 1e-13);
      EXPECT_NEAR(a.d1, b.d1, 1e-12);
      EXPECT_NEAR(a.d2, b.d2, 1e-11) << cells << " cells, node " << i;
    }
  }
}

TEST(ScalarCubic, APeriodicOneOfASineIsOfFourthOrder) {
  double error[2] = {};
  for (const int k : {0, 1}) {
    const int n = k == 0 ? 16 : 32;
    std::vector<double> nodes, values;
    for (int i = 0; i <= n; ++i) {
      nodes.push_back(2.0 * std::acos(-1.0) * i / n);
      values.push_back(std::sin(nodes.back()));
    }
    const auto s = periodic_cubic(nodes, values);
    ASSERT_TRUE(s);
    for (double x = 0.0; x < 6.28; x += 0.01) {
      error[k] = std::max(error[k], std::abs(evaluate(*s, x).value - std::sin(x)));
    }
  }
  // the fourth derivative times h^4 / 384 and what neighbours add to it (a cubic that meets slopes
  // exactly has 1 / 384)
  EXPECT_LT(error[0], 5.0 / 384.0 * std::pow(2.0 * std::acos(-1.0) / 16.0, 4));
  EXPECT_NEAR(error[0] / error[1], 16.0, 1.0);
}

TEST(ScalarCubic, RefusesWhatIsNoSpline) {
  EXPECT_EQ(local_cubic({0.0}, {1.0}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(global_cubic_by_slopes({0.0, 0.0}, {1.0, 1.0}).error().code, ErrorCode::kOutOfOrder);
  EXPECT_EQ(global_cubic_by_seconds({0.0, 1.0}, {1.0}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(global_cubic_by_slopes({0.0, 1.0}, {1.0, std::nan("")}).error().code,
            ErrorCode::kNotFinite);
  const auto line = global_cubic_by_seconds({0.0, 1.0}, {1.0, 3.0});
  ASSERT_TRUE(line);
  EXPECT_DOUBLE_EQ(evaluate(*line, 0.25).value, 1.5);
}

}  // namespace
}  // namespace obvid
