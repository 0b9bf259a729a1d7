// SPDX-License-Identifier: Apache-2.0
// Polynomials by data at two ends and a mean value: docs/methods/idspline.md, section 1.
#include "obvid/idspline/internal/cell.h"

#include <cassert>
#include <cstddef>

#include "obvid/numeric/internal/gauss.h"

namespace obvid {
namespace {

/// Integrals of w^k over the cell, (k!)^2/(2k + 1)!.
constexpr std::array<double, 4> kMoment = {1.0, 1.0 / 6.0, 1.0 / 30.0, 1.0 / 140.0};
/// Their reciprocals, which are integers.
constexpr std::array<double, 4> kPerMoment = {1.0, 6.0, 30.0, 140.0};

double line(const CellPolynomial& cell, std::size_t k, double u) {
  return (1.0 - u) * cell.left[k] + u * cell.right[k];
}

}  // namespace

CellPolynomial hermite_cell(double from, double length, int orders, const NodeJet& left,
                            const NodeJet& right) {
  assert(orders >= 1 && orders <= 3);
  CellPolynomial c{from, length, orders, {}, {}};
  c.left[0] = left[0];
  c.right[0] = right[0];
  if (orders == 1) return c;
  const double rise = right[0] - left[0];
  c.left[1] = length * left[1] - rise;
  c.right[1] = rise - length * right[1];
  if (orders == 2) return c;
  const double square = 0.5 * length * length;
  c.left[2] = square * left[2] + 2.0 * c.left[1] - c.right[1];
  c.right[2] = square * right[2] + 2.0 * c.right[1] - c.left[1];
  return c;
}

CellPolynomial integral_cell(double from, double length, int orders, const NodeJet& left,
                             const NodeJet& right, double mean_value) {
  CellPolynomial c = hermite_cell(from, length, orders, left, right);
  const auto k = static_cast<std::size_t>(orders);
  const double bump = kPerMoment[k] * (mean_value - mean(c));
  c.left[k] = c.right[k] = bump;
  c.terms = orders + 1;
  return c;
}

double value(const CellPolynomial& cell, double x) {
  const double u = (x - cell.from) / cell.length, w = u * (1.0 - u);
  double sum = 0.0;
  for (auto k = static_cast<std::size_t>(cell.terms); k-- > 0;) sum = sum * w + line(cell, k, u);
  return sum;
}

ScalarJet evaluate(const CellPolynomial& cell, double x) {
  const double u = (x - cell.from) / cell.length, w = u * (1.0 - u), w1 = 1.0 - 2.0 * u;
  constexpr double kW2 = -2.0;  // second derivative of w
  ScalarJet p;
  for (auto k = static_cast<std::size_t>(cell.terms); k-- > 0;) {
    p.d3 = p.d3 * w + 3.0 * (p.d2 * w1 + p.d1 * kW2);
    p.d2 = p.d2 * w + 2.0 * p.d1 * w1 + p.value * kW2;
    p.d1 = p.d1 * w + p.value * w1 + (cell.right[k] - cell.left[k]);
    p.value = p.value * w + line(cell, k, u);
  }
  const double per = 1.0 / cell.length;
  p.d1 *= per;
  p.d2 *= per * per;
  p.d3 *= per * per * per;
  return p;
}

double mean(const CellPolynomial& cell) {
  double sum = 0.0;
  for (auto k = static_cast<std::size_t>(cell.terms); k-- > 0;) {
    sum += kMoment[k] * (0.5 * (cell.left[k] + cell.right[k]));
  }
  return sum;
}

double integral(const CellPolynomial& cell, double a, double b) {
  // four points are exact up to degree 7, the largest that a cell can have
  return gauss_integral<4>(a, b, [&](double x) { return value(cell, x); });
}

std::array<double, 8> power_coefficients(const CellPolynomial& cell) {
  std::array<double, 8> c{};
  for (auto k = static_cast<std::size_t>(cell.terms); k-- > 0;) {
    // c = c u (1 - u) + left + (right - left) u
    for (std::size_t j = c.size(); j-- > 0;) {
      c[j] = (j > 0 ? c[j - 1] : 0.0) - (j > 1 ? c[j - 2] : 0.0);
    }
    c[0] += cell.left[k];
    c[1] += cell.right[k] - cell.left[k];
  }
  double per = 1.0;
  for (double& each : c) {
    each *= per;
    per /= cell.length;
  }
  return c;
}

}  // namespace obvid
