// SPDX-License-Identifier: Apache-2.0
// Polynomials of one cell against closed forms.
#include "obvid/idspline/internal/cell.h"

#include <gtest/gtest.h>

#include <cmath>

#include "polynomial.h"

namespace obvid {
namespace {

/// A polynomial of degree 2 orders on [0.7, 2.2], by its own data.
CellPolynomial cell_of(const Polynomial& p, int orders) {
  const auto jet = [&p](double x) { return NodeJet{p.at(x), p.at(x, 1), p.at(x, 2)}; };
  return integral_cell(0.7, 1.5, orders, jet(0.7), jet(2.2), p.integral(0.7, 2.2) / 1.5);
}

TEST(CellPolynomial, IsThePolynomialWhoseDataItWasGiven) {
  const Polynomial p{{0.3, -1.2, 0.7, 1.1, -0.4, 0.25, -0.6}};
  for (const int orders : {1, 2, 3}) {
    const Polynomial q = p.cut(2 * orders);
    const CellPolynomial c = cell_of(q, orders);
    for (const double x : {0.0, 0.7, 0.9, 1.45, 2.2, 3.0}) {  // outside too
      const ScalarJet jet = evaluate(c, x);
      const double scale = std::pow(2.0 + std::abs(x), 2 * orders);
      EXPECT_NEAR(jet.value, q.at(x), 1e-14 * scale) << orders << ' ' << x;
      EXPECT_NEAR(value(c, x), q.at(x), 1e-14 * scale);
      EXPECT_NEAR(jet.d1, q.at(x, 1), 1e-13 * scale);
      EXPECT_NEAR(jet.d2, q.at(x, 2), 1e-12 * scale);
      EXPECT_NEAR(jet.d3, q.at(x, 3), 4e-12 * scale);
    }
  }
}

TEST(CellPolynomial, WithoutAMeanValueItIsHermites) {
  const Polynomial p{{0.3, -1.2, 0.7, 1.1, -0.4, 0.25}};
  for (const int orders : {1, 2, 3}) {
    const Polynomial q = p.cut(2 * orders - 1);
    const auto jet = [&q](double x) { return NodeJet{q.at(x), q.at(x, 1), q.at(x, 2)}; };
    const CellPolynomial c = hermite_cell(-1.0, 0.5, orders, jet(-1.0), jet(-0.5));
    for (const double x : {-1.0, -0.8, -0.5}) EXPECT_NEAR(value(c, x), q.at(x), 4e-15);
    EXPECT_NEAR(mean(c), q.integral(-1.0, -0.5) / 0.5, 4e-15);
  }
}

TEST(CellPolynomial, EndValuesAreMetExactly) {
  const double from = 0.1, to = 0.3, length = to - from;
  const CellPolynomial c =
      integral_cell(from, length, 3, {1.0 / 3.0, 1.7, -2.0}, {-2.0 / 7.0, 0.3, 11.0}, 0.4);
  EXPECT_EQ(value(c, from), 1.0 / 3.0);
  EXPECT_EQ(value(c, to), -2.0 / 7.0);
}

TEST(CellPolynomial, PartsOfTheIntegralAreThoseOfThePolynomial) {
  const Polynomial p{{0.3, -1.2, 0.7, 1.1, -0.4, 0.25, -0.6}};
  const CellPolynomial c = cell_of(p, 3);
  EXPECT_NEAR(integral(c, 0.7, 1.0), p.integral(0.7, 1.0), 1e-13);
  EXPECT_NEAR(integral(c, 1.0, 2.2), p.integral(1.0, 2.2), 1e-13);
  EXPECT_NEAR(integral(c, 2.2, 1.0), -p.integral(1.0, 2.2), 1e-13);
  EXPECT_NEAR(integral(c, 0.0, 3.0), p.integral(0.0, 3.0), 1e-11);
}

TEST(CellPolynomial, CoefficientsOfTheParabolaAreThePublishedOnes) {
  // [004], formula (20), with dI = I - f_i h and df = f_{i+1} - f_i
  const double f0 = 1.7, f1 = -0.4, area = 0.9, h = 0.35;
  const double d_area = area - f0 * h, df = f1 - f0;
  const auto c = power_coefficients(integral_cell(5.0, h, 1, {f0}, {f1}, area / h));
  EXPECT_DOUBLE_EQ(c[0], f0);
  EXPECT_NEAR(c[1], 6.0 * d_area / (h * h) - 2.0 * df / h, 1e-13);
  EXPECT_NEAR(c[2], -6.0 * d_area / (h * h * h) + 3.0 * df / (h * h), 1e-12);
  for (std::size_t k = 3; k < c.size(); ++k) EXPECT_EQ(c[k], 0.0);
}

TEST(CellPolynomial, MirroredDataGiveTheMirroredPolynomialToTheLastBit) {
  const CellPolynomial a = integral_cell(-1.0, 2.0, 3, {0.3, 1.1, -0.7}, {1.9, -0.2, 0.5}, 0.6);
  const CellPolynomial b = integral_cell(-1.0, 2.0, 3, {1.9, 0.2, 0.5}, {0.3, -1.1, -0.7}, 0.6);
  for (const double x : {0.0, 0.25, 0.5, 0.75}) EXPECT_EQ(value(a, x), value(b, -x)) << x;
}

}  // namespace
}  // namespace obvid
