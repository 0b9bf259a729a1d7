// SPDX-License-Identifier: Apache-2.0
#include "slope_system.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obvid::chain_detail {

void SlopeSystem::fix(std::size_t i) {
  const std::size_t first = i - std::min(i, kBand), last = std::min(n_ - 1, i + kBand);
  for (std::size_t k = first; k <= last; ++k) at(i, k) = at(k, i) = 0.0;
  at(i, i) = 1.0;
  right_[i] = 0.0;
}

bool SlopeSystem::solve() {
  // rows end with the next node's block; what is exchanged or taken off may make them longer
  last_column_.resize(n_);
  for (std::size_t i = 0; i < n_; ++i) {
    last_column_[i] = std::min(n_, kBlock * (i / kBlock + 2)) - 1;
  }
  for (std::size_t k = 0; k < n_; ++k) {
    const std::size_t last_row = std::min(n_, kBlock * (k / kBlock + 2)) - 1;
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i <= last_row; ++i) {
      if (std::abs(at(i, k)) > std::abs(at(pivot, k))) pivot = i;
    }
    if (!(std::abs(at(pivot, k)) > 0.0)) return false;
    if (pivot != k) {
      const std::size_t longer = std::max(last_column_[k], last_column_[pivot]);
      for (std::size_t j = k; j <= longer; ++j) std::swap(at(k, j), at(pivot, j));
      std::swap(right_[k], right_[pivot]);
      std::swap(last_column_[k], last_column_[pivot]);
    }
    const std::size_t last_column = last_column_[k];
    const double inverse = 1.0 / at(k, k);
    std::array<double, kReach> pivot_row;  // zero behind its last column
    std::copy_n(&at(k, k) + 1, kReach, pivot_row.begin());
    for (std::size_t i = k + 1; i <= last_row; ++i) {
      const double share = at(i, k) * inverse;
      if (share == 0.0) continue;
      last_column_[i] = std::max(last_column_[i], last_column);
      double* const row = &at(i, k) + 1;
      for (std::size_t j = 0; j < kReach; ++j) row[j] -= share * pivot_row[j];
      right_[i] -= share * right_[k];
    }
  }
  for (std::size_t k = n_; k-- > 0;) {
    double sum = right_[k];
    for (std::size_t j = k + 1; j <= last_column_[k]; ++j) sum -= at(k, j) * right_[j];
    right_[k] = sum / at(k, k);
  }
  return true;
}

}  // namespace obvid::chain_detail
