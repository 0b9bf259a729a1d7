// SPDX-License-Identifier: Apache-2.0
#include "obvid/idspline/internal/scalar_cubic.h"

#include <gtest/gtest.h>

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

TEST(ScalarCubic, RefusesWhatIsNoSpline) {
  EXPECT_EQ(local_cubic({0.0}, {1.0}).error().code, ErrorCode::kTooFewPoints);
  EXPECT_EQ(global_cubic_by_slopes({0.0, 0.0}, {1.0, 1.0}).error().code, ErrorCode::kChordReversal);
  EXPECT_EQ(global_cubic_by_seconds({0.0, 1.0}, {1.0}).error().code, ErrorCode::kUsage);
  EXPECT_EQ(global_cubic_by_slopes({0.0, 1.0}, {1.0, std::nan("")}).error().code,
            ErrorCode::kNotFinite);
  const auto line = global_cubic_by_seconds({0.0, 1.0}, {1.0, 3.0});
  ASSERT_TRUE(line);
  EXPECT_DOUBLE_EQ(evaluate(*line, 0.25).value, 1.5);
}

}  // namespace
}  // namespace obvid
