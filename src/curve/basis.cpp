// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/basis.h"

#include <algorithm>

namespace obvid {
namespace {

constexpr std::size_t kOrders = kMaxNurbsDegree + 1;

using Row = std::array<double, kOrders>;

/// Row r holds the B-splines of degree r that are not zero on the span: j = 0 .. r; nothing is
/// written beyond them, that would cost more than they do.
using Triangle = std::array<Row, kOrders>;

void fill_triangle(std::size_t p, const std::vector<double>& knots, std::size_t k, double u,
                   Triangle& n) {
  n[0][0] = 1.0;
  for (std::size_t r = 1; r <= p; ++r) {
    double left = 0.0;
    for (std::size_t j = 0; j < r; ++j) {
      const double low = knots[k + 1 + j - r], high = knots[k + 1 + j];
      const double share = n[r - 1][j] / (high - low);
      n[r][j] = left + (high - u) * share;
      left = (u - low) * share;
    }
    n[r][r] = left;
  }
}

/// B-splines of one degree become derivatives of those one degree, `r`, higher.
void raise(Row& now, std::size_t r, const std::vector<double>& knots, std::size_t k) {
  double left = 0.0;
  for (std::size_t j = 0; j < r; ++j) {
    const double share =
        static_cast<double>(r) * now[j] / (knots[k + 1 + j] - knots[k + 1 + j - r]);
    now[j] = left - share;
    left = share;
  }
  now[r] = left;
}

}  // namespace

std::size_t span_at(int degree, const std::vector<double>& knots, double u) {
  const auto p = static_cast<std::ptrdiff_t>(degree);
  const auto first = knots.begin() + p, last = knots.end() - p - 1;
  auto k = std::upper_bound(first, last, std::max(u, *first)) - knots.begin() - 1;
  while (k > p && !(knots[static_cast<std::size_t>(k)] < *last)) --k;
  return static_cast<std::size_t>(k);
}

BasisValues basis_at(int degree, const std::vector<double>& knots, double u, int derivatives) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t k = span_at(degree, knots, u);
  Triangle n;
  fill_triangle(p, knots, k, u, n);
  BasisValues basis;
  basis.first = k - p;
  std::copy_n(n[p].begin(), p + 1, basis.value[0].begin());
  const std::size_t orders = std::min(static_cast<std::size_t>(derivatives), p);
  for (std::size_t order = 1; order <= orders; ++order) {
    Row& now = basis.value[order];
    std::copy_n(n[p - order].begin(), p - order + 1, now.begin());
    for (std::size_t r = p - order + 1; r <= p; ++r) raise(now, r, knots, k);
  }
  return basis;
}

}  // namespace obvid
