// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace obvid {

/// Polynomial by its coefficients, as reference.
struct Polynomial {
  std::vector<double> c;

  [[nodiscard]] double at(double x, int derivative = 0) const {
    double sum = 0.0;
    for (std::size_t k = c.size(); k-- > static_cast<std::size_t>(derivative);) {
      double factor = c[k];
      for (int j = 0; j < derivative; ++j) factor *= double(k) - j;
      sum = sum * x + factor;
    }
    return sum;
  }

  /// In wider numbers, so that short intervals keep their digits.
  [[nodiscard]] double integral(double a, double b) const {
    long double sum = 0.0L;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const auto n = static_cast<long double>(k + 1);
      sum += c[k] *
             (std::pow(static_cast<long double>(b), n) - std::pow(static_cast<long double>(a), n)) /
             n;
    }
    return static_cast<double>(sum);
  }

  /// Its terms up to a degree.
  [[nodiscard]] Polynomial cut(int degree) const { return {{c.begin(), c.begin() + degree + 1}}; }
};

}  // namespace obvid
