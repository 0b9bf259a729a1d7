// SPDX-License-Identifier: Apache-2.0
#include "small_program.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace obvid::alignment {
namespace {

constexpr double kSlack = 1e-9;  ///< of the largest coefficient: what counts as kept
/// Of the largest coefficient: what rounding leaves of one that others cancel.
constexpr double kCancelled = 1e-11;

template <std::size_t N>
double product(const std::array<double, N>& a, const std::array<double, N>& x) {
  double sum = 0.0;
  for (std::size_t k = 0; k < N; ++k) sum += a[k] * x[k];
  return sum;
}

/// `a` without unknown `out`, which a row tells by the others.
template <std::size_t N>
std::array<double, N - 1> without(const std::array<double, N>& a, std::size_t out, double share,
                                  const std::array<double, N>& row) {
  std::array<double, N - 1> left;
  for (std::size_t k = 0; k + 1 < N; ++k) {
    const std::size_t from = k < out ? k : k + 1;
    left[k] = a[from] - share * row[from];
  }
  return left;
}

/// One unknown: an interval.
bool on_line(double goal, const std::vector<HalfSpaceOf<1>>& rows, double box, double& x) {
  double low = -box, high = box;
  for (const auto& row : rows) {
    if (row.a[0] > kCancelled) {
      high = std::min(high, row.b / row.a[0]);
    } else if (row.a[0] < -kCancelled) {
      low = std::max(low, row.b / row.a[0]);
    } else if (row.b < -kSlack - kCancelled * box) {
      return false;
    }
  }
  if (low > high) {
    // rounding makes intervals of one value empty
    if (low - high > kSlack * (1.0 + std::abs(low))) return false;
    low = high = 0.5 * (low + high);
  }
  x = goal >= 0.0 ? high : low;
  return true;
}

}  // namespace

template <std::size_t N>
bool SmallProgram::maximum_of(const std::array<double, N>& goal, double box,
                              std::array<double, N>& x) {
  auto& rows = std::get<N>(rows_);
  if constexpr (N == 1) {
    return on_line(goal[0], rows, box, x[0]);
  } else {
    for (std::size_t k = 0; k < N; ++k) x[k] = goal[k] >= 0.0 ? box : -box;
    auto& reduced = std::get<N - 1>(rows_);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const HalfSpaceOf<N>& row = rows[i];
      const double excess = product(row.a, x) - row.b;
      if (excess <= 0.0) continue;
      std::size_t out = 0;
      for (std::size_t k = 1; k < N; ++k) {
        if (std::abs(row.a[k]) > std::abs(row.a[out])) out = k;
      }
      const double largest = std::abs(row.a[out]);
      if (excess <= kSlack * largest) continue;
      if (largest <= kCancelled) {  // parallel to one that the maximum lies on
        if (excess <= kSlack + kCancelled * box) continue;
        return false;
      }
      // the maximum lies on this row's border: one unknown is told by the others
      const double inverse = 1.0 / row.a[out];
      reduced.clear();
      for (std::size_t j = 0; j < i; ++j) {
        const double share = rows[j].a[out] * inverse;
        reduced.push_back({without(rows[j].a, out, share, row.a), rows[j].b - share * row.b});
      }
      std::array<double, N> own{};
      own[out] = 1.0;
      reduced.push_back({without(own, out, inverse, row.a), box - inverse * row.b});
      own[out] = -1.0;
      reduced.push_back({without(own, out, -inverse, row.a), box + inverse * row.b});
      std::array<double, N - 1> inner;
      if (!maximum_of<N - 1>(without(goal, out, goal[out] * inverse, row.a), box, inner)) {
        return false;
      }
      double sum = row.b;
      for (std::size_t k = 0; k + 1 < N; ++k) {
        const std::size_t to = k < out ? k : k + 1;
        x[to] = inner[k];
        sum -= row.a[to] * inner[k];
      }
      x[out] = sum * inverse;
      if constexpr (N == kUnknowns) {
        // what bounds one maximum bounds others: the next ones meet it first
        std::rotate(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(i),
                    rows.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      }
    }
    return true;
  }
}

void SmallProgram::add(const HalfSpace& row) {
  double largest = 0.0;
  for (const double a : row.a) largest = std::max(largest, std::abs(a));
  if (!(largest > 0.0)) largest = 1.0;
  HalfSpace out = row;
  for (double& a : out.a) a /= largest;
  out.b /= largest;
  std::get<kUnknowns>(rows_).push_back(out);
}

void SmallProgram::shuffle() {
  auto& rows = std::get<kUnknowns>(rows_);
  std::uint64_t state = 0x9E3779B97F4A7C15ULL;
  for (std::size_t i = rows.size(); i > 1; --i) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;  // [Knuth 1997]
    std::swap(rows[i - 1], rows[(state >> 33) % i]);
  }
}

std::optional<Unknowns> SmallProgram::maximum(const Unknowns& goal, double box) {
  Unknowns x;
  if (!maximum_of<kUnknowns>(goal, box, x)) return std::nullopt;
  return x;
}

}  // namespace obvid::alignment
