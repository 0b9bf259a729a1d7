// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

#include "drop_field.h"

namespace obvid::toolpath {
namespace {

using Key = std::tuple<double, double, double>;

Key key_of(Vec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0.0 becomes 0.0

/// Numbers of the corners, the same for equal places: 3 for each triangle.
std::vector<std::uint32_t> corner_numbers(const std::vector<FieldTriangle>& triangles) {
  std::vector<std::pair<Key, std::uint32_t>> all;
  all.reserve(3 * triangles.size());
  for (const FieldTriangle& t : triangles) {
    for (const Vec3 p : t.corners)
      all.emplace_back(key_of(p), static_cast<std::uint32_t>(all.size()));
  }
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> numbers(all.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].first != all[i - 1].first) ++number;
    numbers[all[i].second] = number;
  }
  return numbers;
}

struct Side {
  std::uint32_t a, b, triangle, edge;
  [[nodiscard]] bool same(const Side& o) const { return a == o.a && b == o.b; }
};

}  // namespace

void mark_open_sides(std::vector<FieldTriangle>& triangles) {
  const auto corner = corner_numbers(triangles);
  std::vector<Side> sides;
  sides.reserve(corner.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corner[3 * i + k], b = corner[3 * i + (k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), i, k});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& x, const Side& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  std::vector<bool> at_border(corner.size(), false);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool shared = (i > 0 && sides[i].same(sides[i - 1])) ||
                        (i + 1 < sides.size() && sides[i].same(sides[i + 1]));
    if (shared || sides[i].a == sides[i].b) continue;
    auto& open = triangles[sides[i].triangle].open;
    open = static_cast<std::uint8_t>(open | (2U << sides[i].edge));
    at_border[sides[i].a] = at_border[sides[i].b] = true;
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!at_border[corner[3 * i + k]]) continue;
      triangles[i].open = static_cast<std::uint8_t>(triangles[i].open | (16U << k));
    }
  }
}

}  // namespace obvid::toolpath
