// SPDX-License-Identifier: Apache-2.0
#include "bordered_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid::fairing_detail {
namespace {

/// A pivot that rounding pushed to zero or below is lifted to this part of its diagonal entry.
constexpr double kPivotFloor = 16.0 * std::numeric_limits<double>::epsilon();

double inverse_root(double value, double diagonal) {
  return 1.0 / std::sqrt(std::max(value, kPivotFloor * diagonal));
}

/// x := lower^-1 x with inverted pivots.
void forward(const Mat3& l, double* x) {
  x[0] *= l[0][0];
  x[1] = (x[1] - l[1][0] * x[0]) * l[1][1];
  x[2] = (x[2] - l[2][0] * x[0] - l[2][1] * x[1]) * l[2][2];
}

/// x := lower^-T x.
void backward(const Mat3& l, double* x) {
  x[2] *= l[2][2];
  x[1] = (x[1] - l[2][1] * x[2]) * l[1][1];
  x[0] = (x[0] - l[1][0] * x[1] - l[2][0] * x[2]) * l[0][0];
}

}  // namespace

void BorderedSystem::reset(std::size_t nodes, bool closed, bool with_slack) {
  closed_ = closed;
  with_slack_ = with_slack;
  border_ = (closed ? kPerNode : 0) + (with_slack ? 1 : 0);
  blocks_.assign(nodes - (closed ? 1 : 0), Block{});
  for (std::size_t k = 0; k < border_; ++k) {
    column_[k].assign(kPerNode * blocks_.size(), 0.0);
  }
  border_hessian_ = {};
  border_gradient_ = {};
}

void BorderedSystem::add(std::size_t link, const LinkTerms& t) {
  const std::size_t nodes = blocks_.size() + (closed_ ? 1 : 0);
  const std::array<std::size_t, 2> node = {link, link + 1 == nodes ? 0 : link + 1};
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t at = kPerNode * side;
    if (in_border(node[side])) {
      for (std::size_t r = 0; r < kPerNode; ++r) {
        border_gradient_[r] += t.gradient[at + r];
        for (std::size_t c = 0; c <= r; ++c) border_hessian_[r][c] += t.hessian[at + r][at + c];
        if (with_slack_) border_hessian_[slack_index()][r] += t.slack_column[at + r];
      }
      continue;
    }
    Block& b = blocks_[node[side]];
    for (std::size_t r = 0; r < kPerNode; ++r) {
      b.gradient[r] += t.gradient[at + r];
      for (std::size_t c = 0; c <= r; ++c) b.diagonal[r][c] += t.hessian[at + r][at + c];
      if (with_slack_) column_[slack_index()][kPerNode * node[side] + r] += t.slack_column[at + r];
    }
  }
  const bool border_first = in_border(node[0]), border_last = in_border(node[1]);
  for (std::size_t r = 0; r < kPerNode; ++r) {
    for (std::size_t c = 0; c < kPerNode; ++c) {
      const double h = t.hessian[kPerNode + c][r];  // unknown r of the first, c of the second
      if (border_first) {
        column_[r][kPerNode * node[1] + c] += h;
      } else if (border_last) {
        column_[c][kPerNode * node[0] + r] += h;
      } else {
        blocks_[node[0]].coupling[r][c] += h;
      }
    }
  }
  if (with_slack_) add_slack(t.slack_gradient, t.slack_hessian);
}

void BorderedSystem::add(std::size_t node, std::size_t which, double gradient, double hessian) {
  if (in_border(node)) {
    border_gradient_[which] += gradient;
    border_hessian_[which][which] += hessian;
    return;
  }
  blocks_[node].gradient[which] += gradient;
  blocks_[node].diagonal[which][which] += hessian;
}

void BorderedSystem::add(std::size_t node, const Vec3& gradient, const Mat3& hessian) {
  for (std::size_t r = 0; r < kPerNode; ++r) {
    (in_border(node) ? border_gradient_[r] : blocks_[node].gradient[r]) += gradient[r];
    for (std::size_t c = 0; c <= r; ++c) {
      (in_border(node) ? border_hessian_[r][c] : blocks_[node].diagonal[r][c]) += hessian[r][c];
    }
  }
}

void BorderedSystem::add_to_slack_column(std::size_t node, std::size_t which, double value) {
  if (in_border(node)) {
    border_hessian_[slack_index()][which] += value;
  } else {
    column_[slack_index()][kPerNode * node + which] += value;
  }
}

void BorderedSystem::add_slack(double gradient, double hessian) {
  border_gradient_[slack_index()] += gradient;
  border_hessian_[slack_index()][slack_index()] += hessian;
}

double BorderedSystem::diagonal(std::size_t node, std::size_t which) const {
  return in_border(node) ? border_hessian_[which][which] : blocks_[node].diagonal[which][which];
}

void BorderedSystem::fix(std::size_t node, std::size_t which) {
  if (in_border(node)) {
    for (std::size_t k = 0; k < border_; ++k) {
      border_hessian_[which][k] = border_hessian_[k][which] = 0.0;
    }
    border_hessian_[which][which] = 1.0;
    border_gradient_[which] = 0.0;
    std::fill(column_[which].begin(), column_[which].end(), 0.0);
    return;
  }
  Block& b = blocks_[node];
  for (std::size_t k = 0; k < kPerNode; ++k) {
    b.diagonal[which][k] = b.diagonal[k][which] = 0.0;
    b.coupling[which][k] = 0.0;
    if (node > 0) blocks_[node - 1].coupling[k][which] = 0.0;
  }
  b.diagonal[which][which] = 1.0;
  b.gradient[which] = 0.0;
  for (std::size_t k = 0; k < border_; ++k) column_[k][kPerNode * node + which] = 0.0;
}

void BorderedSystem::factorise() {
  factors_.resize(blocks_.size());
  Mat3 taken{};  // what the node before takes off this block
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& b = blocks_[i];
    Factor& f = factors_[i];
    Mat3& l = f.lower;
    l[0][0] = inverse_root(b.diagonal[0][0] - taken[0][0], b.diagonal[0][0]);
    l[1][0] = (b.diagonal[1][0] - taken[1][0]) * l[0][0];
    l[2][0] = (b.diagonal[2][0] - taken[2][0]) * l[0][0];
    l[1][1] = inverse_root(b.diagonal[1][1] - taken[1][1] - l[1][0] * l[1][0], b.diagonal[1][1]);
    l[2][1] = (b.diagonal[2][1] - taken[2][1] - l[2][0] * l[1][0]) * l[1][1];
    l[2][2] = inverse_root(b.diagonal[2][2] - taken[2][2] - l[2][0] * l[2][0] - l[2][1] * l[2][1],
                           b.diagonal[2][2]);
    for (std::size_t c = 0; c < kPerNode; ++c) {
      double x[kPerNode] = {b.coupling[0][c], b.coupling[1][c], b.coupling[2][c]};
      forward(l, x);
      for (std::size_t r = 0; r < kPerNode; ++r) f.carried[r][c] = x[r];
    }
    for (std::size_t r = 0; r < kPerNode; ++r) {
      for (std::size_t c = 0; c <= r; ++c) {
        taken[r][c] = f.carried[0][r] * f.carried[0][c] + f.carried[1][r] * f.carried[1][c] +
                      f.carried[2][r] * f.carried[2][c];
      }
    }
  }
}

void BorderedSystem::substitute(double* v) const {
  const std::size_t n = factors_.size();
  for (std::size_t i = 0; i < n; ++i) {
    double* x = v + kPerNode * i;
    forward(factors_[i].lower, x);
    if (i + 1 == n) break;
    const Mat3& m = factors_[i].carried;
    for (std::size_t c = 0; c < kPerNode; ++c) {
      x[kPerNode + c] -= m[0][c] * x[0] + m[1][c] * x[1] + m[2][c] * x[2];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    double* x = v + kPerNode * i;
    if (i + 1 < n) {
      const Mat3& m = factors_[i].carried;
      const double* y = x + kPerNode;
      for (std::size_t r = 0; r < kPerNode; ++r) {
        x[r] -= m[r][0] * y[0] + m[r][1] * y[1] + m[r][2] * y[2];
      }
    }
    backward(factors_[i].lower, x);
  }
}

/// Dense Cholesky of the border's Schur complement.
void BorderedSystem::solve_border(std::vector<double>& direction,
                                  std::array<double, kMostBorder>& x) {
  std::array<std::array<double, kMostBorder>, kMostBorder> s = border_hessian_;
  for (std::size_t k = 0; k < border_; ++k) {
    solved_[k] = column_[k];
    substitute(solved_[k].data());
  }
  for (std::size_t k = 0; k < border_; ++k) {
    double rhs = -border_gradient_[k];
    for (std::size_t i = 0; i < direction.size(); ++i) rhs -= column_[k][i] * direction[i];
    x[k] = rhs;
    for (std::size_t j = 0; j <= k; ++j) {
      double sum = 0.0;
      for (std::size_t i = 0; i < direction.size(); ++i) sum += column_[k][i] * solved_[j][i];
      s[k][j] -= sum;
    }
  }
  for (std::size_t k = 0; k < border_; ++k) {
    for (std::size_t j = 0; j <= k; ++j) {
      double sum = s[k][j];
      for (std::size_t i = 0; i < j; ++i) sum -= s[k][i] * s[j][i];
      s[k][j] = j == k ? inverse_root(sum, border_hessian_[k][k]) : sum * s[j][j];
    }
    for (std::size_t j = 0; j < k; ++j) x[k] -= s[k][j] * x[j];
    x[k] *= s[k][k];
  }
  for (std::size_t k = border_; k-- > 0;) {
    for (std::size_t j = k + 1; j < border_; ++j) x[k] -= s[j][k] * x[j];
    x[k] *= s[k][k];
  }
  for (std::size_t k = 0; k < border_; ++k) {
    for (std::size_t i = 0; i < direction.size(); ++i) direction[i] -= x[k] * solved_[k][i];
  }
}

double BorderedSystem::solve(std::vector<double>& direction) {
  factorise();
  direction.resize(kPerNode * blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (std::size_t k = 0; k < kPerNode; ++k) {
      direction[kPerNode * i + k] = -blocks_[i].gradient[k];
    }
  }
  substitute(direction.data());
  std::array<double, kMostBorder> border{};
  if (border_ > 0) solve_border(direction, border);
  if (closed_) direction.insert(direction.end(), border.begin(), border.begin() + kPerNode);
  return with_slack_ ? border[slack_index()] : 0.0;
}

double BorderedSystem::decrement(const std::vector<double>& direction,
                                 double slack_direction) const {
  double sum = with_slack_ ? border_gradient_[slack_index()] * slack_direction : 0.0;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    for (std::size_t k = 0; k < kPerNode; ++k) {
      sum += blocks_[i].gradient[k] * direction[kPerNode * i + k];
    }
  }
  if (closed_) {
    for (std::size_t k = 0; k < kPerNode; ++k) {
      sum += border_gradient_[k] * direction[kPerNode * blocks_.size() + k];
    }
  }
  return -sum;
}

}  // namespace obvid::fairing_detail
