// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace obvid::fairing_detail {

/// Unknowns of a node: offset, heading, curvature.
inline constexpr std::size_t kPerNode = 3;
using Vec3 = std::array<double, kPerNode>;
using Mat3 = std::array<Vec3, kPerNode>;  ///< rows

/// Contribution of one link to Newton's equations: gradient and symmetric Hessian by the six
/// unknowns of its two nodes (lower triangle filled), and their coupling to the slack.
struct LinkTerms {
  std::array<double, 2 * kPerNode> gradient{};
  std::array<std::array<double, 2 * kPerNode>, 2 * kPerNode> hessian{};
  std::array<double, 2 * kPerNode> slack_column{};
  double slack_gradient = 0.0;
  double slack_hessian = 0.0;
};

/// Newton's equations of a chain whose points may move: symmetric positive definite, block
/// tridiagonal with 3x3 blocks, and a border of up to four dense columns: the slack of phase 1 and,
/// for a closed chain, the unknowns of its last node. Cholesky block by block: O(n) time and
/// memory.
class BorderedSystem {
 public:
  void reset(std::size_t nodes, bool closed, bool with_slack);

  /// Adds the terms of the link from node `link` to the next one (the first after the last).
  void add(std::size_t link, const LinkTerms& terms);
  /// Adds to the gradient and the diagonal of one unknown.
  void add(std::size_t node, std::size_t which, double gradient, double hessian);
  /// Adds to the gradient and the diagonal block (lower triangle) of a node.
  void add(std::size_t node, const Vec3& gradient, const Mat3& hessian);
  /// Adds to the coupling of an unknown to the slack.
  void add_to_slack_column(std::size_t node, std::size_t which, double value);
  /// Takes an unknown out of the system. Call after everything was added.
  void fix(std::size_t node, std::size_t which);
  [[nodiscard]] double diagonal(std::size_t node, std::size_t which) const;
  void add_slack(double gradient, double hessian);

  /// Newton direction, minus the inverse Hessian times the gradient, 3 entries per node; the
  /// direction of the slack is returned. Keeps the gradient.
  double solve(std::vector<double>& direction);
  /// Predicted decrease of that direction: minus gradient times direction.
  [[nodiscard]] double decrement(const std::vector<double>& direction,
                                 double slack_direction) const;

 private:
  static constexpr std::size_t kMostBorder = kPerNode + 1;
  struct Block {
    Mat3 diagonal{};  // lower triangle used
    Mat3 coupling{};  // of this node (rows) to the next (columns)
    Vec3 gradient{};
  };
  struct Factor {
    Mat3 lower{};    // Cholesky factor of the reduced diagonal block, pivots inverted
    Mat3 carried{};  // lower^-1 * coupling
  };

  void factorise();
  void substitute(double* values) const;
  void solve_border(std::vector<double>& direction, std::array<double, kMostBorder>& border);
  [[nodiscard]] bool in_border(std::size_t node) const { return node >= blocks_.size(); }
  [[nodiscard]] std::size_t slack_index() const { return border_ - 1; }

  std::vector<Block> blocks_;
  std::vector<Factor> factors_;
  std::array<std::vector<double>, kMostBorder> column_, solved_;
  std::array<std::array<double, kMostBorder>, kMostBorder> border_hessian_{};
  std::array<double, kMostBorder> border_gradient_{};
  std::size_t border_ = 0;
  bool closed_ = false, with_slack_ = false;
};

}  // namespace obvid::fairing_detail
