// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace obvid {

/// Solves a x = b of a few equations by elimination with row exchanges; `b` becomes the solution. A
/// right side is a number, or a vector of anything that has sums and multiples by `Real`. False
/// where a pivot is 0 or not a number; near a singular matrix nothing is promised.
template <class Real, std::size_t N, class Right>
[[nodiscard]] bool solve_small(std::array<std::array<Real, N>, N> a, std::array<Right, N>& b) {
  using std::abs;
  for (std::size_t i = 0; i < N; ++i) {
    std::size_t largest = i;
    for (std::size_t j = i + 1; j < N; ++j) {
      if (abs(a[j][i]) > abs(a[largest][i])) largest = j;
    }
    std::swap(a[i], a[largest]);
    std::swap(b[i], b[largest]);
    if (!(abs(a[i][i]) > Real(0))) return false;
    for (std::size_t j = i + 1; j < N; ++j) {
      const Real part = a[j][i] / a[i][i];
      for (std::size_t k = i + 1; k < N; ++k) a[j][k] -= part * a[i][k];
      b[j] = b[j] - part * b[i];
    }
  }
  for (std::size_t i = N; i-- > 0;) {
    for (std::size_t k = i + 1; k < N; ++k) b[i] = b[i] - a[i][k] * b[k];
    b[i] = (Real(1) / a[i][i]) * b[i];
  }
  return true;
}

}  // namespace obvid
