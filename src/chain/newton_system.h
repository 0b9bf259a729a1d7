// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace obvid::chain_detail {

/// Newton's equations of the chain: symmetric positive definite, block tridiagonal with 2x2
/// blocks (heading, curvature of one node), and one dense border for the slack of phase 1.
/// Factorised as L D L^T block by block: O(n) time and memory.
class NewtonSystem {
 public:
  struct Block {
    double a00 = 0.0, a10 = 0.0, a11 = 0.0;             ///< diagonal block, lower part
    double o00 = 0.0, o01 = 0.0, o10 = 0.0, o11 = 0.0;  ///< coupling of this node to the next
    double g0 = 0.0, g1 = 0.0;                          ///< gradient
    double c0 = 0.0, c1 = 0.0;                          ///< column of the slack
  };

  void reset(std::size_t nodes) {
    blocks_.assign(nodes, Block{});
    slack_hessian = 0.0;
    slack_gradient = 0.0;
  }
  [[nodiscard]] Block& operator[](std::size_t i) { return blocks_[i]; }
  [[nodiscard]] std::size_t size() const { return blocks_.size(); }

  /// Takes variable `which` (0 heading, 1 curvature) of a node out of the system.
  void fix(std::size_t node, int which);

  /// Newton direction: minus the inverse Hessian times the gradient. Keeps the gradient.
  void solve(std::vector<double>& direction, double& slack_direction, bool with_slack);

  /// Predicted decrease: minus gradient times direction.
  [[nodiscard]] double decrement(const std::vector<double>& direction,
                                 double slack_direction) const;

  double slack_hessian = 0.0;
  double slack_gradient = 0.0;

 private:
  struct Factor {
    double i00, l10, i11;       // of the diagonal block: unit triangle, pivots inverted
    double m00, m01, m10, m11;  // (L D)^-1 times the coupling
  };
  void factorise();
  void substitute(std::vector<double>& r) const;

  std::vector<Block> blocks_;
  std::vector<Factor> factors_;
  std::vector<double> column_;
};

}  // namespace obvid::chain_detail
