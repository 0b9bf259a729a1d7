// SPDX-License-Identifier: Apache-2.0
#include "slope_system.h"

#include <algorithm>
#include <cmath>

namespace obvid::chain_detail {

void SlopeSystem::fix(std::size_t i) {
  const std::size_t first = i - std::min(i, kBand), last = std::min(n_ - 1, i + kBand);
  for (std::size_t k = first; k <= last; ++k) at(i, k) = at(k, i) = 0.0;
  at(i, i) = 1.0;
  right_[i] = 0.0;
}

bool SlopeSystem::solve() {
  for (std::size_t k = 0; k < n_; ++k) {
    const std::size_t last_row = std::min(n_ - 1, k + kBand);
    const std::size_t last_column = std::min(n_ - 1, k + 2 * kBand);
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i <= last_row; ++i) {
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    }
    if (!(std::abs(at(pivot, k)) > 0.0)) return false;
    if (pivot != k) {
      for (std::size_t j = k; j <= last_column; ++j) std::swap(at(k, j), at(pivot, j));
      std::swap(right_[k], right_[pivot]);
    }
    const double inverse = 1.0 / at(k, k);
    for (std::size_t i = k + 1; i <= last_row; ++i) {
      const double share = at(i, k) * inverse;
      if (share == 0.0) continue;
      for (std::size_t j = k + 1; j <= last_column; ++j) at(i, j) -= share * at(k, j);
      right_[i] -= share * right_[k];
    }
  }
  for (std::size_t k = n_; k-- > 0;) {
    double sum = right_[k];
    const std::size_t last_column = std::min(n_ - 1, k + 2 * kBand);
    for (std::size_t j = k + 1; j <= last_column; ++j) sum -= at(k, j) * right_[j];
    right_[k] = sum / at(k, k);
  }
  return true;
}

}  // namespace obvid::chain_detail
