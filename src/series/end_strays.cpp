// SPDX-License-Identifier: Apache-2.0
// Strays at the ends of an open row: docs/methods/series.md.
#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "end_parabola.h"
#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/small_system.h"
#include "obvid/series/internal/strays.h"
#include "outlier_rules.h"

namespace obvid {
namespace {

constexpr double kOpen = 3.0;  // middle steps between the ends, at least

}  // namespace

PastEnd past_end(Vec2 point, const std::array<Vec2, kBehind>& behind, std::size_t steps) {
  std::array<double, kBehind> t{};
  for (std::size_t k = 1; k < kBehind; ++k) t[k] = t[k - 1] - norm(behind[k] - behind[k - 1]);
  const double unit = -t.back() / static_cast<double>(kBehind - 1);
  if (!(unit > 0.0)) return {};
  std::array<double, 5> sum{};  // of powers of t
  std::array<Vec2, 3> right{};
  for (std::size_t k = 0; k < kBehind; ++k) {
    const double u = t[k] / unit;
    double power = 1.0;
    for (std::size_t j = 0; j < sum.size(); ++j, power *= u) {
      sum[j] += power;
      if (j < right.size()) right[j] = right[j] + power * (behind[k] - behind.front());
    }
  }
  const std::array<std::array<double, 3>, 3> normal = {
      {{sum[0], sum[1], sum[2]}, {sum[1], sum[2], sum[3]}, {sum[2], sum[3], sum[4]}}};
  if (!solve_small(normal, right)) return {};
  const auto [a, b, c] = right;
  const Vec2 q = point - behind.front();
  const double gap = norm(q);
  double u = gap / unit;
  constexpr int kNewton = 20;
  for (int k = 0; k < kNewton; ++k) {
    const Vec2 away = a + u * b + (u * u) * c - q, slope = b + (2.0 * u) * c;
    const double rate = dot(slope, slope);
    if (!(rate > 0.0)) break;
    u = std::max(0.0, u - dot(away, slope) / rate);
  }
  PastEnd out;
  out.off = norm(a + u * b + (u * u) * c - q);
  // what a parabola does not know of a curve grows with the cube of the way
  const double along = dot(q, b) / std::max(norm(b), std::numeric_limits<double>::min());
  const double longer = std::max(1.0, along / (static_cast<double>(steps) * unit));
  out.unseen = longer * longer * longer;
  out.turns = dot(q, b) < kHalfStraight * gap * norm(b);
  return out;
}

namespace {

/// Points at the start of a row that stray, up to three, and how far they are off.
template <class At>
std::vector<std::pair<std::size_t, double>> strays_of_end(const At& at, std::size_t n,
                                                          const RowGoesOn& row) {
  const auto off_at = [&](std::size_t place, std::size_t first) -> std::optional<double> {
    const auto one = past_end_at(at, n, place, first, row.middle_step);
    return one && row.is_off(*one) ? std::optional(one->off) : std::nullopt;
  };
  for (std::size_t count = kMostInARow; count > 0; --count) {
    std::vector<std::pair<std::size_t, double>> out;
    for (std::size_t k = 0; k < count; ++k) {
      const auto off = off_at(k, count);
      // without the first point behind it too, which may be the wrong one
      if (off && off_at(k, count + 1)) out.emplace_back(k, *off);
    }
    // each of them is off what lies behind them, which goes on without them
    if (out.size() == count && !off_at(count, count + 1)) return out;
  }
  return {};
}

}  // namespace

std::optional<OrderBesideStrays> without_end_strays(const std::vector<Vec2>& points,
                                                    const CurveOrder& order) {
  const std::size_t n = order.order.size();
  if (n < kLeastCompared + 2 * (kMostInARow + kBehind) || order.is_outline) return std::nullopt;
  const auto forward = [&](std::size_t k) { return points[order.order[k]]; };
  const auto backward = [&](std::size_t k) { return points[order.order[n - 1 - k]]; };
  const RowGoesOn row = row_goes_on(forward, n);
  if (!(order.gap > kOpen * row.middle_step)) return std::nullopt;
  const auto before = strays_of_end(forward, n, row), behind = strays_of_end(backward, n, row);
  if (before.empty() && behind.empty()) return std::nullopt;
  OrderBesideStrays out;
  const double least = std::max(kOfFarthest * row.farthest, kOfStep * row.middle_step);
  out.strays.deviation = row.median;
  out.strays.limit = row.median > 0.0 ? least / row.median : 0.0;
  for (const auto& [k, off] : before) out.strays.points.push_back({order.order[k], off});
  for (const auto& [k, off] : behind) out.strays.points.push_back({order.order[n - 1 - k], off});
  out.order.order.assign(order.order.begin() + static_cast<std::ptrdiff_t>(before.size()),
                         order.order.end() - static_cast<std::ptrdiff_t>(behind.size()));
  const std::vector<std::size_t>& left = out.order.order;
  for (std::size_t k = 1; k < left.size(); ++k) {
    out.order.largest_step =
        std::max(out.order.largest_step, norm(points[left[k]] - points[left[k - 1]]));
  }
  out.order.gap = norm(points[left.back()] - points[left.front()]);
  return out;
}

}  // namespace obvid
