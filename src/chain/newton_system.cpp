// SPDX-License-Identifier: Apache-2.0
#include "newton_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid::chain_detail {
namespace {

/// A pivot that rounding pushed to zero or below is lifted to this part of its diagonal entry.
constexpr double kPivotFloor = 16.0 * std::numeric_limits<double>::epsilon();

double inverse(double pivot, double diagonal) {
  return 1.0 / std::max(pivot, kPivotFloor * diagonal);
}

}  // namespace

void NewtonSystem::fix(std::size_t node, int which) {
  Block& b = blocks_[node];
  Block* before = node > 0 ? &blocks_[node - 1] : nullptr;
  b.a10 = 0.0;
  if (which == 0) {
    b.a00 = 1.0;
    b.o00 = b.o01 = b.g0 = b.c0 = 0.0;
    if (before != nullptr) before->o00 = before->o10 = 0.0;
  } else {
    b.a11 = 1.0;
    b.o10 = b.o11 = b.g1 = b.c1 = 0.0;
    if (before != nullptr) before->o01 = before->o11 = 0.0;
  }
}

void NewtonSystem::factorise() {
  factors_.resize(blocks_.size());
  double d00 = 0.0, d10 = 0.0, d11 = 0.0;  // what the node before takes off this block
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    const Block& b = blocks_[i];
    Factor& f = factors_[i];
    const double a10 = b.a10 - d10;
    f.i00 = inverse(b.a00 - d00, b.a00);
    f.l10 = a10 * f.i00;
    f.i11 = inverse(b.a11 - d11 - f.l10 * a10, b.a11);
    const double o10 = b.o10 - f.l10 * b.o00, o11 = b.o11 - f.l10 * b.o01;
    f.m00 = b.o00 * f.i00;
    f.m01 = b.o01 * f.i00;
    f.m10 = o10 * f.i11;
    f.m11 = o11 * f.i11;
    d00 = b.o00 * f.m00 + o10 * f.m10;
    d10 = b.o00 * f.m01 + o10 * f.m11;
    d11 = b.o01 * f.m01 + o11 * f.m11;
  }
}

void NewtonSystem::substitute(std::vector<double>& r) const {
  const std::size_t n = factors_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Factor& f = factors_[i];
    const double y0 = r[2 * i];
    const double y1 = r[2 * i + 1] - f.l10 * y0;
    r[2 * i] = y0 * f.i00;
    r[2 * i + 1] = y1 * f.i11;
    if (i + 1 == n) break;
    r[2 * i + 2] -= f.m00 * y0 + f.m10 * y1;
    r[2 * i + 3] -= f.m01 * y0 + f.m11 * y1;
  }
  double x0 = 0.0, x1 = 0.0;  // solution at the node after
  for (std::size_t i = n; i-- > 0;) {
    const Factor& f = factors_[i];
    const double z0 = r[2 * i] - (f.m00 * x0 + f.m01 * x1);
    x1 = r[2 * i + 1] - (f.m10 * x0 + f.m11 * x1);
    x0 = z0 - f.l10 * x1;
    r[2 * i] = x0;
    r[2 * i + 1] = x1;
  }
}

void NewtonSystem::solve(std::vector<double>& direction, double& slack_direction, bool with_slack) {
  factorise();
  const std::size_t n = blocks_.size();
  direction.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    direction[2 * i] = -blocks_[i].g0;
    direction[2 * i + 1] = -blocks_[i].g1;
  }
  substitute(direction);
  slack_direction = 0.0;
  if (!with_slack) return;
  column_.resize(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    column_[2 * i] = blocks_[i].c0;
    column_[2 * i + 1] = blocks_[i].c1;
  }
  substitute(column_);
  double schur = slack_hessian, rhs = -slack_gradient;
  for (std::size_t i = 0; i < n; ++i) {
    schur -= blocks_[i].c0 * column_[2 * i] + blocks_[i].c1 * column_[2 * i + 1];
    rhs -= blocks_[i].c0 * direction[2 * i] + blocks_[i].c1 * direction[2 * i + 1];
  }
  slack_direction = rhs / std::max(schur, kPivotFloor * slack_hessian);
  for (std::size_t i = 0; i < 2 * n; ++i) direction[i] -= slack_direction * column_[i];
}

double NewtonSystem::decrement(const std::vector<double>& direction, double slack_direction) const {
  double sum = slack_gradient * slack_direction;
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    sum += blocks_[i].g0 * direction[2 * i] + blocks_[i].g1 * direction[2 * i + 1];
  }
  return -sum;
}

}  // namespace obvid::chain_detail
