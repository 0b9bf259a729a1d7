// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "obvid/idspline/internal/id_spline.h"

namespace obvid::idspline {

/// Sum with the rounding of each addition kept ([Neumaier 1974]).
class ExactSum {
 public:
  void add(double x) {
    const double sum = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - sum) + x : (x - sum) + sum_;
    sum_ = sum;
  }
  [[nodiscard]] double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0.0, rest_ = 0.0;
};

/// Sum over the cells between a and b of `whole(i)` or, for parts, of `part(i, low, high)`.
template <class Whole, class Part>
double integrate(const std::vector<double>& nodes, double a, double b, const Whole& whole,
                 const Part& part) {
  if (b < a) return -integrate(nodes, b, a, whole, part);
  if (!(a <= b)) return a + b;  // no numbers
  const std::size_t first = cell_index(nodes, a), last = cell_index(nodes, b);
  ExactSum sum;
  for (std::size_t i = first; i <= last; ++i) {
    const double low = i == first ? a : nodes[i], high = i == last ? b : nodes[i + 1];
    const bool all = low == nodes[i] && high == nodes[i + 1];
    sum.add(all ? whole(i) : part(i, low, high));
  }
  return sum.value();
}

}  // namespace obvid::idspline
