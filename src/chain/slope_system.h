// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace obvid::chain_detail {

/// Equations of one step towards a chain with continuous slopes: symmetric, indefinite, block
/// tridiagonal with three unknowns a node (heading, curvature, multiplier of the slopes' equality).
/// Gaussian elimination with row exchanges inside the band: O(n) time and memory.
class SlopeSystem {
 public:
  static constexpr std::size_t kBlock = 3;  ///< unknowns of a node

  void reset(std::size_t nodes) {
    n_ = kBlock * nodes;
    entry_.assign(n_ * kWidth, 0.0);
    right_.assign(n_, 0.0);
  }
  /// Entry of row i and column j; the rows' nodes are neighbours, or the same.
  [[nodiscard]] double& at(std::size_t i, std::size_t j) {
    return entry_[i * kWidth + (j + kBand - i)];
  }
  [[nodiscard]] double& right(std::size_t i) { return right_[i]; }
  [[nodiscard]] std::size_t size() const { return n_; }

  /// Takes an unknown out of the system: it stays as it is.
  void fix(std::size_t i);

  /// The right sides become the solution. False where the matrix is singular to rounding.
  [[nodiscard]] bool solve();
  [[nodiscard]] const std::vector<double>& solution() const { return right_; }

 private:
  static constexpr std::size_t kBand = 2 * kBlock - 1;  // diagonals on either side
  static constexpr std::size_t kReach = 2 * kBand;      // the same with what row exchanges fill in
  static constexpr std::size_t kWidth = kBand + 1 + kReach;

  std::size_t n_ = 0;
  std::vector<double> entry_, right_;
  std::vector<std::size_t> last_column_;  ///< of each row, that may differ from 0
};

}  // namespace obvid::chain_detail
