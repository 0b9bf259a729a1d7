// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace obvid {

[[nodiscard]] constexpr double inverse_of(double x) { return 1.0 / x; }

/// Linear equations before m_{i-1} + here m_i + behind m_{i+1} = right, solved by elimination
/// without pivoting: O(n), for rows that are dominated by their diagonal or symmetric and positive
/// definite, as those of splines are.
///
/// `Block` is double or a small square matrix with `inverse_of`, Block * Block, Block - Block;
/// `Right` is whatever a Block multiplies: double, a point, a small vector.
template <class Block, class Right>
class TridiagonalSystem {
 public:
  explicit TridiagonalSystem(std::size_t n) : upper_(n), right_(n) {}

  void set_first(const Block& here, const Block& behind, const Right& right) {
    put(0, here, behind, right);
  }

  /// Row i > 0, in ascending order.
  void add(std::size_t i, const Block& before, const Block& here, const Block& behind,
           const Right& right) {
    put(i, here - before * upper_[i - 1], behind, right - before * right_[i - 1]);
  }

  /// The unknowns; the system is used up.
  std::vector<Right> solve() {
    for (std::size_t i = right_.size() - 1; i-- > 0;) {
      right_[i] = right_[i] - upper_[i] * right_[i + 1];
    }
    return std::move(right_);
  }

 private:
  void put(std::size_t i, const Block& here, const Block& behind, const Right& right) {
    const Block inverse = inverse_of(here);
    upper_[i] = inverse * behind;
    right_[i] = inverse * right;
  }

  std::vector<Block> upper_;
  std::vector<Right> right_;
};

}  // namespace obvid
