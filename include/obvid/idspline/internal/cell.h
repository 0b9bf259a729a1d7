// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace obvid {

/// Value and derivatives of a function of one variable.
struct ScalarJet {
  double value = 0.0, d1 = 0.0, d2 = 0.0, d3 = 0.0;
};

/// Value, first and second derivative at a node.
using NodeJet = std::array<double, 3>;

/// Polynomial on one cell in two-point form: with u = (x - from)/length and w = u(1 - u)
///
///     S = sum over k < terms of w^k (left[k] (1 - u) + right[k] u),     terms <= 4.
///
/// left[0] and right[0] are the end values, and the terms up to k settle k derivatives at both
/// ends whatever follows. Ends are met exactly, mirroring exchanges left and right, and rounding is
/// that of the end data: no large coefficients cancel (docs/methods/idspline.md, section 1).
struct CellPolynomial {
  double from = 0.0;
  double length = 1.0;  ///< > 0
  int terms = 1;
  std::array<double, 4> left{}, right{};
};

/// Polynomial of degree 2 orders - 1 with the value and the first `orders` - 1 derivatives given at
/// both ends; `orders` 1, 2 or 3.
[[nodiscard]] CellPolynomial hermite_cell(double from, double length, int orders,
                                          const NodeJet& left, const NodeJet& right);

/// The same ends and a given mean value over the cell: a polynomial of degree 2 orders.
[[nodiscard]] CellPolynomial integral_cell(double from, double length, int orders,
                                           const NodeJet& left, const NodeJet& right, double mean);

[[nodiscard]] double value(const CellPolynomial& cell, double x);
[[nodiscard]] ScalarJet evaluate(const CellPolynomial& cell, double x);

/// Mean value over the whole cell.
[[nodiscard]] double mean(const CellPolynomial& cell);

/// Integral from a to b, which may lie anywhere; exact but for rounding.
[[nodiscard]] double integral(const CellPolynomial& cell, double a, double b);

/// Coefficients by powers of x - from, as published formulas state a link. Evaluation does without
/// them.
[[nodiscard]] std::array<double, 8> power_coefficients(const CellPolynomial& cell);

}  // namespace obvid
