// SPDX-License-Identifier: Apache-2.0
// Block tridiagonal systems with a border against dense elimination in extended precision.
#include "bordered_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace obvid::fairing_detail {
namespace {

using Long = long double;
using Dense = std::vector<std::vector<Long>>;

double uniform(std::mt19937_64& rng) { return static_cast<double>(rng() >> 11) * 0x1p-52 - 1.0; }

/// Gauss with partial pivoting.
std::vector<Long> solve_dense(Dense a, std::vector<Long> b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
    }
    std::swap(a[c], a[pivot]);
    std::swap(b[c], b[pivot]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const Long f = a[r][c] / a[c][c];
      for (std::size_t k = c; k < n; ++k) a[r][k] -= f * a[c][k];
      b[r] -= f * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

/// The same terms in a bordered system and in a dense one, whose last unknown is the slack.
class Pair {
 public:
  Pair(std::size_t nodes, bool closed, bool with_slack, unsigned seed)
      : nodes_(nodes), size_(kPerNode * nodes + 1), with_slack_(with_slack), rng_(seed) {
    system.reset(nodes, closed, with_slack);
    dense_.assign(size_, std::vector<Long>(size_));
    gradient_.assign(size_, 0.0L);
    const std::size_t links = closed ? nodes : nodes - 1;
    for (std::size_t i = 0; i < links; ++i) add_link(i);
    for (std::size_t i = 0; i < nodes; ++i) add_node(i);
    if (!with_slack) dense_.back().back() = 1.0L;
  }

  void fix(std::size_t node, std::size_t which) {
    system.fix(node, which);
    const std::size_t k = kPerNode * node + which;
    for (std::size_t j = 0; j < size_; ++j) dense_[k][j] = dense_[j][k] = 0.0L;
    dense_[k][k] = 1.0L;
    gradient_[k] = 0.0L;
  }

  void expect_equal_solutions(const std::string& what) {
    std::vector<Long> rhs;
    for (const Long g : gradient_) rhs.push_back(-g);
    const std::vector<Long> expected = solve_dense(dense_, rhs);
    std::vector<double> direction;
    const double slack = system.solve(direction);
    ASSERT_EQ(direction.size(), kPerNode * nodes_) << what;
    Long decrement = 0.0L, largest = 0.0L;
    for (const Long e : expected) largest = std::max(largest, std::abs(e));
    for (std::size_t i = 0; i < direction.size(); ++i) {
      EXPECT_NEAR(direction[i], static_cast<double>(expected[i]),
                  1e-11 * static_cast<double>(largest))
          << what << ", unknown " << i;
      decrement -= gradient_[i] * expected[i];
    }
    EXPECT_NEAR(slack, static_cast<double>(expected.back()), 1e-11 * static_cast<double>(largest))
        << what;
    decrement -= gradient_.back() * expected.back();
    EXPECT_NEAR(system.decrement(direction, slack), static_cast<double>(decrement),
                1e-10 * static_cast<double>(decrement))
        << what;
  }

  BorderedSystem system;

 private:
  void add_link(std::size_t i) {
    const std::size_t next = (i + 1) % nodes_;
    LinkTerms t;
    // a sum of squares, so that everything stays positive definite
    for (int square = 0; square < 4; ++square) {
      double v[2 * kPerNode + 1];
      for (double& x : v) x = uniform(rng_);
      for (std::size_t r = 0; r < 2 * kPerNode; ++r) {
        for (std::size_t c = 0; c <= r; ++c) t.hessian[r][c] += v[r] * v[c];
        if (with_slack_) t.slack_column[r] += v[r] * v[2 * kPerNode];
      }
      if (with_slack_) t.slack_hessian += v[2 * kPerNode] * v[2 * kPerNode];
    }
    for (double& g : t.gradient) g = uniform(rng_);
    if (with_slack_) t.slack_gradient = uniform(rng_);
    system.add(i, t);
    const auto place = [&](std::size_t k) {
      return k < kPerNode ? kPerNode * i + k : kPerNode * next + k - kPerNode;
    };
    for (std::size_t r = 0; r < 2 * kPerNode; ++r) {
      gradient_[place(r)] += t.gradient[r];
      for (std::size_t c = 0; c <= r; ++c) {
        dense_[place(r)][place(c)] += t.hessian[r][c];
        if (c != r) dense_[place(c)][place(r)] += t.hessian[r][c];
      }
      dense_[place(r)].back() += t.slack_column[r];
      dense_.back()[place(r)] += t.slack_column[r];
    }
    gradient_.back() += t.slack_gradient;
    dense_.back().back() += t.slack_hessian;
  }

  void add_node(std::size_t i) {
    const double g = uniform(rng_), h = 0.5 + 0.4 * uniform(rng_);
    system.add(i, 1, g, h);
    gradient_[kPerNode * i + 1] += g;
    dense_[kPerNode * i + 1][kPerNode * i + 1] += h;
    Vec3 gradient{};
    Mat3 block{};
    double v[kPerNode];
    for (std::size_t k = 0; k < kPerNode; ++k) {
      v[k] = uniform(rng_);
      gradient[k] = uniform(rng_);
    }
    for (std::size_t r = 0; r < kPerNode; ++r) {
      gradient_[kPerNode * i + r] += gradient[r];
      for (std::size_t c = 0; c < kPerNode; ++c) {
        if (c <= r) block[r][c] = v[r] * v[c];
        dense_[kPerNode * i + r][kPerNode * i + c] += v[r] * v[c];
      }
    }
    system.add(i, gradient, block);
    if (!with_slack_) return;
    const double mixed = 0.1 * uniform(rng_), own = 1.0;
    system.add_to_slack_column(i, 2, mixed);
    system.add_slack(g, own);
    dense_[kPerNode * i + 2].back() += mixed;
    dense_.back()[kPerNode * i + 2] += mixed;
    gradient_.back() += g;
    dense_.back().back() += own;
  }

  std::size_t nodes_, size_;
  bool with_slack_;
  std::mt19937_64 rng_;
  Dense dense_;
  std::vector<Long> gradient_;
};

TEST(BorderedSystem, SolvesWhatDenseEliminationSolves) {
  unsigned seed = 1;
  for (const bool closed : {false, true}) {
    for (const bool with_slack : {false, true}) {
      for (const std::size_t nodes : {3, 4, 7, 40}) {
        Pair pair(nodes, closed, with_slack, seed++);
        pair.expect_equal_solutions(std::to_string(nodes) + (closed ? " closed" : " open") +
                                    (with_slack ? " with slack" : ""));
      }
    }
  }
}

TEST(BorderedSystem, KeepsFixedUnknownsAndSolvesTheOthers) {
  unsigned seed = 100;
  for (const bool closed : {false, true}) {
    for (const bool with_slack : {false, true}) {
      constexpr std::size_t kNodes = 9;
      Pair pair(kNodes, closed, with_slack, seed++);
      for (const std::size_t node : {0, 3, 4, 8}) pair.fix(node, node % kPerNode);
      pair.fix(kNodes - 1, 0);
      pair.expect_equal_solutions(std::string(closed ? "closed" : "open") +
                                  (with_slack ? " with slack" : ""));
      std::vector<double> direction;
      pair.system.solve(direction);
      EXPECT_EQ(direction[kPerNode * (kNodes - 1)], 0.0);
    }
  }
}

}  // namespace
}  // namespace obvid::fairing_detail
