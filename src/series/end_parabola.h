// SPDX-License-Identifier: Apache-2.0
// How a row goes on beyond an end (docs/methods/series.md).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/median.h"
#include "outlier_rules.h"

namespace obvid {

inline constexpr std::size_t kBehind = 6;  ///< points that say where the curve comes from
/// What an end may be off where its row goes on as it does elsewhere: so many times the farthest
/// that any other point is off the same curve of the points on one side of it, and of a step.
inline constexpr double kOfFarthest = 4.0, kOfStep = 0.25;
/// Of a middle step: points that say where a curve comes from are farther apart than this, so that
/// their errors do not say it for them.
inline constexpr double kApart = 0.1;

/// Cosine of half of what a curve turns by at the most over a gap: so far aside lies what it leads
/// to.
inline constexpr double kHalfStraight = 0.9238795325112867;

/// A point beyond others of its row.
struct PastEnd {
  double off = 0.0;     ///< distance from the parabola through those behind it, gone on to it
  double unseen = 1.0;  ///< what the curve may do over a gap, by what it does over a step
  bool turns = false;   ///< the curve would turn by more than 45 degrees on the way to it

  [[nodiscard]] double by_step() const { return off / unseen; }
};

/// The parabola is that of least squares over the chords; of `steps` steps. `behind` begins with
/// the nearest one.
[[nodiscard]] PastEnd past_end(Vec2 point, const std::array<Vec2, kBehind>& behind,
                               std::size_t steps);

/// `at(k)`, k < n: a row from one of its ends. The point at `place` as those from `first` on see
/// it; nothing where there are too few of these.
template <class At>
std::optional<PastEnd> past_end_at(const At& at, std::size_t n, std::size_t place,
                                   std::size_t first, double middle_step) {
  std::array<Vec2, kBehind> behind{};
  std::size_t found = 0;
  for (std::size_t k = first; k < n && found < kBehind; ++k) {
    if (found > 0 && norm(at(k) - behind[found - 1]) < kApart * middle_step) continue;
    behind[found++] = at(k);
  }
  if (found < kBehind) return std::nullopt;
  return past_end(at(place), behind, first - place);
}

/// The farthest, by a step, that any point of a row is off what those beside it say, and the middle
/// one of all.
struct RowGoesOn {
  double middle_step = 0.0, farthest = 0.0, median = 0.0;

  [[nodiscard]] bool is_off(const PastEnd& one) const {
    const double least = kOfFarthest * farthest;
    return one.off > kOfStep * middle_step && (one.turns ? one.off > least : one.by_step() > least);
  }
};

template <class At>
RowGoesOn row_goes_on(const At& at, std::size_t n) {
  RowGoesOn out;
  std::vector<double> steps, offs;
  for (std::size_t k = 1; k < n; ++k) steps.push_back(norm(at(k) - at(k - 1)));
  out.middle_step = median_of(std::move(steps));
  const auto backward = [&](std::size_t k) { return at(n - 1 - k); };
  for (std::size_t k = kMostInARow; k + kMostInARow + kBehind < n; ++k) {
    if (const auto one = past_end_at(at, n, k, k + 1, out.middle_step)) {
      offs.push_back(one->by_step());
    }
    if (const auto one = past_end_at(backward, n, k, k + 1, out.middle_step)) {
      offs.push_back(one->by_step());
    }
  }
  if (offs.empty()) return out;
  out.farthest = *std::max_element(offs.begin(), offs.end());
  out.median = median_of(std::move(offs));
  return out;
}

}  // namespace obvid
