// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace obvid {

/// Square matrix with `below` and `above` diagonals beside the main one, factored without pivoting:
/// for totally positive or diagonally dominant matrices, as those of B-splines are. O(n) time and
/// memory for fixed widths; one factorisation serves any number of right sides.
class BandedMatrix {
 public:
  BandedMatrix(std::size_t n, std::size_t below, std::size_t above)
      : n_(n), below_(below), above_(above), entry_(n * (below + above + 1), 0.0) {}

  [[nodiscard]] std::size_t size() const { return n_; }

  /// Entry in row i, column j; |i - j| within the widths.
  [[nodiscard]] double& at(std::size_t i, std::size_t j) {
    return entry_[i * (below_ + above_ + 1) + (j + below_ - i)];
  }
  [[nodiscard]] double at(std::size_t i, std::size_t j) const {
    return entry_[i * (below_ + above_ + 1) + (j + below_ - i)];
  }

  /// Replaces the entries by the factors. False when a pivot is not greater than 0.
  [[nodiscard]] bool factor() {
    for (std::size_t k = 0; k < n_; ++k) {
      if (!(at(k, k) > 0.0)) return false;
      for (std::size_t i = k + 1; i < std::min(n_, k + below_ + 1); ++i) {
        const double share = at(i, k) /= at(k, k);
        for (std::size_t j = k + 1; j < std::min(n_, k + above_ + 1); ++j) {
          at(i, j) -= share * at(k, j);
        }
      }
    }
    return true;
  }

  /// Solves for a right side that is changed into the solution: `line(i)` gives a reference to what
  /// stands in row i, anything with `subtract(line, factor, line)` and `divide(line, number)`.
  template <class Lines, class Subtract, class Divide>
  void solve(const Lines& line, const Subtract& subtract, const Divide& divide) const {
    for (std::size_t i = 1; i < n_; ++i) {
      for (std::size_t k = i - std::min(i, below_); k < i; ++k) {
        if (at(i, k) != 0.0) subtract(line(i), at(i, k), line(k));
      }
    }
    for (std::size_t i = n_; i-- > 0;) {
      for (std::size_t k = i + 1; k < std::min(n_, i + above_ + 1); ++k) {
        if (at(i, k) != 0.0) subtract(line(i), at(i, k), line(k));
      }
      divide(line(i), at(i, i));
    }
  }

  /// Solves for one right side of numbers or points.
  template <class Right>
  [[nodiscard]] std::vector<Right> solve(std::vector<Right> right) const {
    solve([&](std::size_t i) -> Right& { return right[i]; },
          [](Right& a, double factor, const Right& b) { a = a - factor * b; },
          [](Right& a, double pivot) { a = a / pivot; });
    return right;
  }

  /// Solves for all columns of a matrix at once, its rows of `width` in one piece each: the inner
  /// loops run over rows, which compilers make vectors of.
  template <class Right>
  void solve_rows(std::vector<Right>& rows, std::size_t width) const {
    solve([&](std::size_t i) { return rows.data() + i * width; },
          [&](Right* a, double factor, const Right* b) {
            for (std::size_t k = 0; k < width; ++k) a[k] = a[k] - factor * b[k];
          },
          [&](Right* a, double pivot) {
            for (std::size_t k = 0; k < width; ++k) a[k] = a[k] / pivot;
          });
  }

 private:
  std::size_t n_, below_, above_;
  std::vector<double> entry_;
};

}  // namespace obvid
