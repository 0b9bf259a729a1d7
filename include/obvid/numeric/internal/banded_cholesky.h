// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace obvid {

/// Symmetric positive definite matrix with `band` diagonals on either side of the main one, as the
/// factors R^T R. n band^2 multiplications, n (band + 1) numbers of memory: the upper half alone,
/// four rows at a time, so that the inner loops are made vectors of.
class BandedCholesky {
 public:
  BandedCholesky(std::size_t n, std::size_t band)
      : n_(n), band_(band), width_(band + 1), entry_(n * width_, 0.0) {}

  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t band() const { return band_; }

  /// Entry in row i, column j >= i, within the band.
  [[nodiscard]] double& at(std::size_t i, std::size_t j) { return row(i)[j - i]; }
  /// Entries (i, i), (i, i + 1), ..., (i, i + band); those beyond the last column stay 0.
  [[nodiscard]] double* row(std::size_t i) { return entry_.data() + i * width_; }
  [[nodiscard]] const double* row(std::size_t i) const { return entry_.data() + i * width_; }

  /// Replaces the entries by the factor. False when the matrix is not positive definite in double
  /// precision, or when `go_on()`, asked every few rows, is false.
  template <class GoOn>
  [[nodiscard]] bool factor(const GoOn& go_on) {
    return factor_first(n_, go_on);
  }

  /// The same for the first `count` rows: the others keep what is left of the matrix when the first
  /// unknowns are eliminated.
  template <class GoOn>
  [[nodiscard]] bool factor_first(std::size_t count, const GoOn& go_on) {
    for (std::size_t k = 0; k < count; k += kAtOnce) {
      if (k % (16 * kAtOnce) == 0 && !go_on()) return false;
      const std::size_t rows = std::min(kAtOnce, count - k);
      for (std::size_t p = 0; p < rows; ++p) {
        for (std::size_t q = 0; q < p; ++q) subtract(k + q, k + p);
        if (!scale(k + p)) return false;
      }
      for (std::size_t i = k + rows; i < std::min(n_, k + rows + band_); ++i) {
        if (rows == kAtOnce) {
          subtract_all(k, i);
        } else {
          for (std::size_t q = 0; q < rows; ++q) subtract(k + q, i);
        }
      }
    }
    return true;
  }

  /// Solution for a right side, of the factored matrix.
  [[nodiscard]] std::vector<double> solve(std::vector<double> x) const {
    forward_first(n_, x);
    back_first(n_, x);
    return x;
  }
  /// The two halves of it for the first `count` unknowns: what they take from the right side, all
  /// the others included; and their values when those behind them are known.
  void forward_first(std::size_t count, std::vector<double>& x) const {
    for (std::size_t k = 0; k < count; ++k) {
      const double* from = row(k);
      const double value = x[k] /= from[0];
      for (std::size_t t = 1; t <= reach(k); ++t) x[k + t] -= from[t] * value;
    }
  }
  void back_first(std::size_t count, std::vector<double>& x) const {
    for (std::size_t k = count; k-- > 0;) {
      const double* from = row(k);
      double sum = x[k];
      for (std::size_t t = 1; t <= reach(k); ++t) sum -= from[t] * x[k + t];
      x[k] = sum / from[0];
    }
  }

 private:
  static constexpr std::size_t kAtOnce = 4;

  [[nodiscard]] std::size_t reach(std::size_t k) const { return std::min(band_, n_ - 1 - k); }

  bool scale(std::size_t k) {
    double* entries = row(k);
    if (!(entries[0] > 0.0) || !std::isfinite(entries[0])) return false;
    const double root = std::sqrt(entries[0]);
    for (std::size_t t = 0; t <= band_; ++t) entries[t] /= root;
    return true;
  }

  /// What row k of the factor takes from row i.
  void subtract(std::size_t k, std::size_t i) {
    const std::size_t shift = i - k;
    if (shift > band_) return;
    const double* from = entry_.data() + k * width_ + shift;
    double* to = entry_.data() + i * width_;
    const double share = from[0];
    for (std::size_t t = 0; t + shift <= band_; ++t) to[t] -= share * from[t];
  }

  /// The same for the four rows from k on.
  void subtract_all(std::size_t k, std::size_t i) {
    std::array<const double*, kAtOnce> from{};
    std::array<double, kAtOnce> share{};
    const std::size_t nearest = i - k - (kAtOnce - 1);  // shift of the last of them
    for (std::size_t p = 0; p < kAtOnce; ++p) {
      const std::size_t shift = i - k - p;
      from[p] = entry_.data() + (k + p) * width_ + std::min(shift, width_ - 1);
      share[p] = shift <= band_ ? *from[p] : 0.0;
    }
    const std::size_t all = i - k <= band_ ? band_ - (i - k) + 1 : 0;
    double* to = entry_.data() + i * width_;
    for (std::size_t t = 0; t < all; ++t) {
      to[t] -= share[0] * from[0][t] + share[1] * from[1][t] + share[2] * from[2][t] +
               share[3] * from[3][t];
    }
    for (std::size_t t = all; t + nearest <= band_; ++t) {
      for (std::size_t p = 0; p < kAtOnce; ++p) {
        if (t + (i - k - p) <= band_) to[t] -= share[p] * from[p][t];
      }
    }
  }

  std::size_t n_, band_, width_;
  std::vector<double> entry_;
};

}  // namespace obvid
