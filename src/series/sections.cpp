// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/sections.h"

#include <algorithm>
#include <numeric>

namespace obvid {
namespace {

/// A loop needs this many points after the repeated one is dropped.
constexpr std::size_t kSmallestLoop = 3;

}  // namespace

bool returns_to_start(const std::vector<Vec2>& points, double tolerance_of_first,
                      double tolerance_of_last) {
  if (points.size() <= kSmallestLoop) return false;
  return norm(points.back() - points.front()) <= tolerance_of_first + tolerance_of_last;
}

JoinedPoint join_points(Vec2 a, double tolerance_a, Vec2 b, double tolerance_b) {
  const double distance = norm(b - a);
  const double least = std::min(tolerance_a, tolerance_b);
  if (distance == 0.0) return {a, least};
  // Largest disc in the lens of the two discs: the smaller disc itself where it lies inside.
  const double half_lens = 0.5 * (tolerance_a + tolerance_b - distance);
  if (half_lens >= least) return {tolerance_a <= tolerance_b ? a : b, least};
  const double from_a = 0.5 * (tolerance_a - tolerance_b + distance);
  return {a + (from_a / distance) * (b - a), std::max(half_lens, 0.0)};
}

SplitSeries split_sections(std::size_t count, const std::vector<std::size_t>& corners,
                           bool closed) {
  SplitSeries split;
  split.order.resize(count);
  std::iota(split.order.begin(), split.order.end(), std::size_t{0});
  if (count == 0) return split;
  if (!closed) {
    std::size_t first = 0;
    for (const std::size_t corner : corners) {
      split.sections.push_back({first, corner});
      first = corner;
    }
    split.sections.push_back({first, count - 1});
    return split;
  }
  if (corners.empty()) {
    split.smooth_loop = true;
    split.sections.push_back({0, count});
    return split;
  }
  const std::size_t start = corners.front();
  std::rotate(split.order.begin(), split.order.begin() + static_cast<std::ptrdiff_t>(start),
              split.order.end());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = i + 1 < corners.size() ? corners[i + 1] : start + count;
    split.sections.push_back({corners[i] - start, next - start});
  }
  return split;
}

}  // namespace obvid
