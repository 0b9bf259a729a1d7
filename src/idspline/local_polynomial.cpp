// SPDX-License-Identifier: Apache-2.0
#include "local_polynomial.h"

#include <algorithm>

namespace obvid::idspline {
namespace {

/// First of `count` neighbouring nodes, of which `before` lie before node i where there is room.
std::size_t first_of(std::size_t i, std::size_t before, std::size_t count, std::size_t nodes) {
  return std::min(i - std::min(i, before), nodes - count);
}

double integral_of(const LocalPolynomial& c, double h) {
  const double quarter = 0.25 * h * h;  // square of the half step; odd powers cancel
  return h * (c[0] + quarter * (c[2] / 3.0 + quarter * (c[4] / 5.0 + quarter * c[6] / 7.0)));
}

}  // namespace

LocalPolynomial local_polynomial(std::span<const double> nodes, std::span<const double> values,
                                 std::size_t first, std::size_t count, double at) {
  LocalPolynomial difference{};
  for (std::size_t j = 0; j < count; ++j) difference[j] = values[first + j];
  for (std::size_t order = 1; order < count; ++order) {
    for (std::size_t j = count; j-- > order;) {
      difference[j] =
          (difference[j] - difference[j - 1]) / (nodes[first + j] - nodes[first + j - order]);
    }
  }
  LocalPolynomial c{};
  for (std::size_t j = count; j-- > 0;) {  // c = c (x - node) + difference
    const double shift = at - nodes[first + j];
    for (std::size_t k = kMostPoints; k-- > 1;) c[k] = c[k] * shift + c[k - 1];
    c[0] = c[0] * shift + difference[j];
  }
  return c;
}

std::vector<double> local_derivatives(std::span<const double> nodes, std::span<const double> values,
                                      int degree, int order) {
  const std::size_t n = nodes.size(), before = static_cast<std::size_t>(degree / 2);
  const std::size_t count = std::min(n, static_cast<std::size_t>(degree + 1));
  const double factorial = order == 2 ? 2.0 : 1.0;
  std::vector<double> out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto c = local_polynomial(nodes, values, first_of(i, before, count, n), count, nodes[i]);
    out[i] = factorial * c[static_cast<std::size_t>(order)];
  }
  return out;
}

std::vector<double> local_integrals(std::span<const double> nodes, std::span<const double> values,
                                    int degree) {
  const std::size_t n = nodes.size(), before = static_cast<std::size_t>(degree / 2);
  const std::size_t count = std::min(n, static_cast<std::size_t>(degree + 1));
  std::vector<double> out(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = nodes[i + 1] - nodes[i], middle = nodes[i] + 0.5 * h;
    const std::size_t a = first_of(i, before, count, n), b = first_of(i, before - 1, count, n);
    const double left = integral_of(local_polynomial(nodes, values, a, count, middle), h);
    out[i] = a == b ? left
                    : 0.5 * left +
                          0.5 * integral_of(local_polynomial(nodes, values, b, count, middle), h);
  }
  return out;
}

}  // namespace obvid::idspline
