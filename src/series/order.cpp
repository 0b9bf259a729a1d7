// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "order_by_tree.h"
#include "outline_tour.h"
#include "spanning_tree.h"

namespace obvid {
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

namespace {

constexpr std::size_t kFewestCompared = 8, kMostOfTour = 3'000;
constexpr std::size_t kFewestOfTour = 12;  // fewer have hardly any rival to look at

/// From the end of the longest step that comes first in the list.
CurveOrder opened_at_the_longest_step(const std::vector<Vec2>& points,
                                      std::vector<std::size_t> tour) {
  const std::size_t n = tour.size();
  CurveOrder out;
  out.is_outline = true;
  std::size_t last = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double step = norm(points[tour[(i + 1) % n]] - points[tour[i]]);
    if (step > out.gap) {
      out.gap = step;
      last = i;
    }
  }
  std::rotate(tour.begin(), tour.begin() + static_cast<std::ptrdiff_t>((last + 1) % n), tour.end());
  if (tour.back() < tour.front()) std::reverse(tour.begin(), tour.end());
  for (std::size_t i = 0; i + 1 < n; ++i) {
    out.largest_step = std::max(out.largest_step, norm(points[tour[i + 1]] - points[tour[i]]));
  }
  out.order = std::move(tour);
  return out;
}

std::string place_text(Vec2 p) { return significant(p.x) + ", " + significant(p.y); }

bool may_be_compared(std::size_t n) { return n >= kFewestCompared && n <= kMostOfTour; }

/// What is found beside the tree: a short closed way, and where its order is not certain.
struct Outline {
  std::vector<std::size_t> tour;
  std::optional<std::size_t> uncertain;
};

Outline outline_of(const std::vector<Vec2>& points) {
  Outline out{short_tour(points), {}};
  out.uncertain =
      points.size() < kFewestOfTour ? out.tour.front() : uncertain_place(points, out.tour, true);
  return out;
}

/// `what` is wrong with the tree at a point.
Error no_order(const std::vector<Vec2>& points, std::size_t at, std::string what,
               std::optional<std::size_t> uncertain) {
  if (uncertain) {
    what += fmt::format(", and of an outline through all points the order is not certain at {}",
                        place_text(points[*uncertain]));
  }
  return error(ErrorCode::kOutOfOrder, what)
      .point(at)
      .hint(
          "thin points that scatter more than they are apart; give more points there, or curves "
          "that meet one by one");
}

Result<CurveOrder> order_of_tree(const std::vector<Vec2>& points, std::size_t branch) {
  const std::string what = fmt::format("the points are no single row: at {} three ways part",
                                       place_text(points[branch]));
  if (!may_be_compared(points.size())) return fail(no_order(points, branch, what, {}));
  Outline outline = outline_of(points);
  if (outline.uncertain) return fail(no_order(points, branch, what, outline.uncertain));
  return opened_at_the_longest_step(points, std::move(outline.tour));
}

/// The row of the tree where it is that of a short closed way, or neither turns sharply nor may be
/// joined otherwise; else that way where its order is certain.
Result<CurveOrder> order_of_row(const std::vector<Vec2>& points, CurveOrder row) {
  if (!may_be_compared(points.size())) return row;
  Outline outline = outline_of(points);
  if (same_neighbours(row.order, outline.tour)) return row;
  if (!outline.uncertain) return opened_at_the_longest_step(points, std::move(outline.tour));
  auto place = sharp_turn(points, row.order);
  if (!place) place = uncertain_end(points, row.order);
  if (!place) place = uncertain_place(points, row.order, false);
  if (!place) return row;
  return fail(
      no_order(points, *place,
               "the order of the shortest row is not certain at " + place_text(points[*place]),
               outline.uncertain));
}

}  // namespace

Result<void> check_order_count(const std::vector<Vec2>& points) {
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
  return {};
}

Result<CurveOrder> order_along_curve(const std::vector<Vec2>& points) {
  OBVID_TRY(check_order_count(points));
  return order_by_tree(points, shortest_tree(points));
}

Result<CurveOrder> order_by_tree(const std::vector<Vec2>& points, const std::vector<Edge>& tree) {
  const std::size_t n = points.size();
  constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();
  std::vector<std::array<std::size_t, 2>> beside(n, {kNobody, kNobody});
  CurveOrder out;
  std::size_t branch = kNobody;
  for (const auto& [a, b] : tree) {
    const double step = norm(points[a] - points[b]);
    if (!(step > 0.0)) {
      return error(ErrorCode::kOutOfOrder, "two points coincide").point(b);
    }
    out.largest_step = std::max(out.largest_step, step);
    for (const auto& [one, other] : {Edge{a, b}, Edge{b, a}}) {
      auto& free = beside[one][0] == kNobody ? beside[one][0] : beside[one][1];
      if (free != kNobody) {
        branch = std::min(branch, one);
        continue;
      }
      free = other;
    }
  }
  if (branch != kNobody) {
    return order_of_tree(points, branch);
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
  return order_of_row(points, std::move(out));
}

}  // namespace obvid
