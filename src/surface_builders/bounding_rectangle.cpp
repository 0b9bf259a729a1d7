// SPDX-License-Identifier: Apache-2.0
#include "bounding_rectangle.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace obvid {
namespace {

/// Counter-clockwise, without points on its sides (Andrew 1979).
std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto go_along = [&](auto from, auto to) {
    const std::size_t base = hull.size();
    for (auto p = from; p != to; ++p) {
      while (hull.size() >= base + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  go_along(points.begin(), points.end());
  go_along(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

TurnedRectangle smallest_rectangle(std::vector<Vec2> points) {
  TurnedRectangle best;
  if (points.empty()) return best;
  const std::vector<Vec2> hull = convex_hull(std::move(points));
  best.corner = hull.front();
  const std::size_t n = hull.size();
  double least = -1.0;
  std::size_t right = 1, top = 1, left = 1;
  const auto next = [n](std::size_t k) { return (k + 1) % n; };
  // the farthest corner in a direction goes round the hull with the sides
  const auto climb = [&](std::size_t& k, Vec2 direction) {
    for (std::size_t step = 0; step < n; ++step) {
      if (dot(hull[next(k)] - hull[k], direction) < 0.0) break;
      k = next(k);
    }
  };
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    const Vec2 side = hull[next(i)] - hull[i];
    const double length = std::hypot(side.x, side.y);
    if (!(length > 0.0)) continue;
    const Vec2 along = side / length, up = left_normal(along);
    if (i == 0) right = next(i);
    climb(right, along);
    if (i == 0) top = right;
    climb(top, up);
    if (i == 0) left = top;
    climb(left, -along);
    const double width = dot(hull[right] - hull[left], along), depth = dot(hull[top] - hull[i], up);
    if (least >= 0.0 && !(width * depth < least)) continue;
    least = width * depth;
    best = {hull[i] + dot(hull[left] - hull[i], along) * along, along, width, depth};
  }
  if (best.depth > best.width) {
    best.corner = best.corner + best.width * best.along;
    best.along = left_normal(best.along);
    std::swap(best.width, best.depth);
  }
  const bool backwards =
      std::abs(best.along.x) >= std::abs(best.along.y) ? best.along.x < 0.0 : best.along.y < 0.0;
  if (backwards) {
    best.corner = best.corner + best.width * best.along + best.depth * left_normal(best.along);
    best.along = -best.along;
  }
  return best;
}

}  // namespace obvid
