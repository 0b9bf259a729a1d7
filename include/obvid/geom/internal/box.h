// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Smallest upright rectangle around what was added; empty at first: from +infinity to -infinity.
struct Box2 {
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();

  Vec2 low{kNowhere, kNowhere};
  Vec2 high{-kNowhere, -kNowhere};

  constexpr void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] constexpr bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] constexpr Vec2 size() const { return high - low; }
  /// 0 when nothing was added.
  [[nodiscard]] double diagonal() const { return empty() ? 0.0 : norm(size()); }
};

/// The same in space.
struct Box3 {
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();

  Vec3 low{kNowhere, kNowhere, kNowhere};
  Vec3 high{-kNowhere, -kNowhere, -kNowhere};

  constexpr void add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  constexpr void add_box(const Box3& other) {
    add(other.low);
    add(other.high);
  }
  void add_all(const std::vector<Vec3>& points) {
    for (const Vec3& p : points) add(p);
  }
  [[nodiscard]] constexpr bool empty() const { return !(low.x <= high.x); }
  [[nodiscard]] constexpr Vec3 size() const { return high - low; }
  /// 0 when nothing was added.
  [[nodiscard]] double diagonal() const { return empty() ? 0.0 : norm(size()); }
  [[nodiscard]] constexpr Vec3 middle() const { return low + 0.5 * size(); }
};

/// Diagonal of the box around points in space.
[[nodiscard]] inline double bounding_diagonal(const std::vector<Vec3>& points) {
  Box3 box;
  box.add_all(points);
  return box.diagonal();
}

/// The same around all points of several things: `points_of(one)` are its points.
template <class All, class PointsOf>
[[nodiscard]] double bounding_diagonal(const All& all, const PointsOf& points_of) {
  Box3 box;
  for (const auto& one : all) box.add_all(std::invoke(points_of, one));
  return box.diagonal();
}

/// Largest distance of points from the first of them: 0 where all are one.
template <class Points, class Distance>
[[nodiscard]] double farthest_from_first(const Points& points, const Distance& distance) {
  double out = 0.0;
  for (const auto& p : points) out = std::max(out, distance(p, points.front()));
  return out;
}

[[nodiscard]] inline double farthest_from_first(const std::vector<Vec3>& points) {
  return farthest_from_first(points, [](Vec3 p, Vec3 first) { return norm(p - first); });
}

}  // namespace obvid
