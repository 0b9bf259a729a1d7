// SPDX-License-Identifier: Apache-2.0
#include "banded_halves.h"

#include <algorithm>
#include <array>
#include <utility>

#include "obvid/core/internal/parallel.h"

namespace obvid {

BandedHalves::BandedHalves(const BandedCholesky& matrix)
    : n_(matrix.size()),
      between_(std::min(matrix.band(), n_)),
      first_((n_ - between_) / 2),
      last_(n_ - between_ - first_),
      down_(first_ + between_, matrix.band()),
      up_(last_ + between_, matrix.band()),
      middle_(between_, between_ > 0 ? between_ - 1 : 0) {
  const std::size_t end = first_ + between_;  // of those that `down_` sees
  for (std::size_t i = 0; i < n_; ++i) {
    const double* from = matrix.row(i);
    for (std::size_t t = 0; t <= matrix.band() && i + t < n_; ++t) {
      // what lies in the middle alone belongs to the first half
      (i + t < end ? down_.at(i, i + t) : up_.at(n_ - 1 - i - t, n_ - 1 - i)) = from[t];
    }
  }
}

Result<bool> BandedHalves::factor(const RunContext& run) {
  std::array<bool, 2> factored{};
  OBVID_TRY(in_parallel(2, run, [&](std::size_t side, const RunContext& part) {
    const auto go_on = [&] { return may_go_on(part).has_value(); };
    factored[side] = side == 0 ? down_.factor_first(first_, go_on) : up_.factor_first(last_, go_on);
  }));
  if (!factored[0] || !factored[1]) return false;
  for (std::size_t i = 0; i < between_; ++i) {
    for (std::size_t j = i; j < between_; ++j) {
      middle_.at(i, j) = down_.at(first_ + i, first_ + j) +
                         up_.at(last_ + between_ - 1 - j, last_ + between_ - 1 - i);
    }
  }
  bool stopped = false;  // `run` is not asked again once it said so
  const bool whole = middle_.factor([&] {
    stopped = !may_go_on(run);
    return !stopped;
  });
  if (stopped) return fail(cancelled_error());
  return whole;
}

std::vector<double> BandedHalves::solve(const std::vector<double>& right) const {
  const auto ends = [](auto from, std::size_t count, std::size_t all) {
    std::vector<double> x(from, from + static_cast<std::ptrdiff_t>(count));
    x.resize(all, 0.0);
    return x;
  };
  std::vector<double> down = ends(right.begin(), first_ + between_, first_ + between_);
  std::vector<double> up = ends(right.rbegin(), last_, last_ + between_);
  down_.forward_first(first_, down);
  up_.forward_first(last_, up);
  std::vector<double> middle(between_);
  for (std::size_t i = 0; i < between_; ++i) {
    middle[i] = down[first_ + i] + up[last_ + between_ - 1 - i];
  }
  middle = middle_.solve(std::move(middle));
  for (std::size_t i = 0; i < between_; ++i) {
    down[first_ + i] = up[last_ + between_ - 1 - i] = middle[i];
  }
  down_.back_first(first_, down);
  up_.back_first(last_, up);
  down.insert(down.end(), up.rend() - static_cast<std::ptrdiff_t>(last_), up.rend());
  return down;
}

}  // namespace obvid
