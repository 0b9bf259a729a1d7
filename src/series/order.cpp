// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/core/internal/figures.h"

namespace obvid {
namespace {

constexpr std::size_t kMostOrdered = 20'000;

using Edge = std::pair<std::size_t, std::size_t>;

/// Edges of the shortest spanning tree; of equal ones those of the points that come first.
std::vector<Edge> shortest_tree(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  std::vector<double> distance(n, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> from(n, 0);
  std::vector<bool> inside(n, false);
  std::vector<Edge> out;
  std::size_t last = 0;
  inside[0] = true;
  for (std::size_t k = 1; k < n; ++k) {
    std::size_t next = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (inside[i]) continue;
      const double d = norm(points[i] - points[last]);
      if (d < distance[i]) {
        distance[i] = d;
        from[i] = last;
      }
      if (next == n || distance[i] < distance[next]) next = i;
    }
    out.emplace_back(from[next], next);
    inside[next] = true;
    last = next;
  }
  return out;
}

}  // namespace

Result<CurveOrder> order_along_curve(const std::vector<Vec2>& points) {
  const std::size_t n = points.size();
  if (n < 3) {
    return error(ErrorCode::kTooFewPoints, "an order needs 3 points at least")
        .value(static_cast<double>(n));
  }
  if (n > kMostOrdered) {
    return error(ErrorCode::kBadCount, fmt::format("{} points are too many to be put in order", n))
        .hint(fmt::format("thin them to {}", kMostOrdered))
        .value(static_cast<double>(n));
  }
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  std::vector<std::array<std::size_t, 2>> beside(n, {kNobody, kNobody});
  CurveOrder out;
  for (const auto& [a, b] : shortest_tree(points)) {
    const double step = norm(points[a] - points[b]);
    if (!(step > 0.0)) {
      return error(ErrorCode::kOutOfOrder, "two points coincide").point(b);
    }
    out.largest_step = std::max(out.largest_step, step);
    for (const auto& [one, other] : {Edge{a, b}, Edge{b, a}}) {
      auto& free = beside[one][0] == kNobody ? beside[one][0] : beside[one][1];
      if (free != kNobody) {
        return error(ErrorCode::kOutOfOrder,
                     fmt::format("the points are no single row: at {}, {} three ways part",
                                 significant(points[one].x), significant(points[one].y)))
            .point(one)
            .hint(
                "thin points that scatter more than they are apart; give curves that meet one "
                "by one");
      }
      free = other;
    }
  }
  std::size_t at = 0;
  while (beside[at][1] != kNobody) ++at;  // a row has two ends
  std::size_t before = kNobody;
  while (at != kNobody) {
    out.order.push_back(at);
    const std::size_t next = beside[at][0] == before ? beside[at][1] : beside[at][0];
    before = std::exchange(at, next);
  }
  out.gap = norm(points[out.order.front()] - points[out.order.back()]);
  return out;
}

}  // namespace obvid
