// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/basis.h"

#include <algorithm>

namespace obvid {
namespace {

constexpr std::size_t kOrders = kMaxSurfaceDegree + 1;

/// Row r holds the B-splines of degree r that are not zero on the span: j = 0 .. r.
using Triangle = std::array<std::array<double, kOrders>, kOrders>;

Triangle triangle_at(std::size_t p, const std::vector<double>& knots, std::size_t k, double u) {
  Triangle n{};
  n[0][0] = 1.0;
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = 0; j < r; ++j) {
      const double low = knots[k + 1 + j - r], high = knots[k + 1 + j];
      const double share = n[r - 1][j] / (high - low);
      n[r][j] += (high - u) * share;
      n[r][j + 1] += (u - low) * share;
    }
  }
  return n;
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
  const Triangle n = triangle_at(p, knots, k, u);
  BasisValues basis;
  basis.first = k - p;
  basis.value[0] = n[p];
  for (std::size_t order = 1;
       order <= std::min<std::size_t>(static_cast<std::size_t>(derivatives), p); ++order) {
    // B-splines of degree p - order are combined into derivatives, one degree at a time
    std::array<double, kOrders> now = n[p - order];
    for (std::size_t r = p - order + 1; r <= p; ++r) {
      std::array<double, kOrders> raised{};
      for (std::size_t j = 0; j < r; ++j) {
        const double share =
            static_cast<double>(r) * now[j] / (knots[k + 1 + j] - knots[k + 1 + j - r]);
        raised[j] -= share;
        raised[j + 1] += share;
      }
      now = raised;
    }
    basis.value[order] = now;
  }
  return basis;
}

}  // namespace obvid
