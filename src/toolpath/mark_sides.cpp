// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

#include "drop_field.h"

namespace obvid::toolpath {
namespace {

using Key = std::tuple<double, double, double>;

Key key_of(Vec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0.0 becomes 0.0

/// Numbers of the corners, the same for equal places: 3 for each triangle.
std::vector<std::uint32_t> corner_numbers(const std::vector<Mesh>& meshes,
                                          const LargeList<FieldTriangle>& triangles) {
  std::vector<std::pair<Key, std::size_t>> all;  // of vertices, in the order of the meshes
  std::vector<std::size_t> first;
  for (const Mesh& mesh : meshes) {
    first.push_back(all.size());
    for (const MeshVertex& vertex : mesh.vertices) {
      all.emplace_back(key_of(vertex.point), all.size());
    }
  }
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> of_vertex(all.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i > 0 && all[i].first != all[i - 1].first) ++number;
    of_vertex[all[i].second] = number;
  }
  std::vector<std::uint32_t> numbers;
  numbers.reserve(3 * triangles.size());
  for (const FieldTriangle& t : triangles) {
    for (const std::uint32_t k : meshes[t.mesh].triangles[t.number]) {
      numbers.push_back(of_vertex[first[t.mesh] + k]);
    }
  }
  return numbers;
}

struct Side {
  std::uint32_t a = 0, b = 0, triangle = 0, edge = 0;
  [[nodiscard]] bool same(const Side& o) const { return a == o.a && b == o.b; }
};

/// Of all triangles, those between the same two corners one after another. Put in order by their
/// first corner at once: few have the same one.
std::vector<Side> sides_in_order(const std::vector<std::uint32_t>& corner) {
  const std::uint32_t most = corner.empty() ? 0 : *std::max_element(corner.begin(), corner.end());
  const auto side = [&](std::size_t n) {
    const std::size_t i = n / 3, k = n % 3;
    const std::uint32_t a = corner[n], b = corner[3 * i + (k + 1) % 3];
    return Side{std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(i),
                static_cast<std::uint32_t>(k)};
  };
  std::vector<std::size_t> next(std::size_t{most} + 2, 0);  // place of the next side of each corner
  for (std::size_t n = 0; n < corner.size(); ++n) ++next[side(n).a + 1];
  for (std::size_t a = 1; a < next.size(); ++a) next[a] += next[a - 1];
  std::vector<Side> out(corner.size());
  for (std::size_t n = 0; n < corner.size(); ++n) {
    const Side one = side(n);
    out[next[one.a]++] = one;
  }
  std::size_t begin = 0;
  for (std::size_t a = 0; a + 1 < next.size(); ++a) {
    const auto from = out.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to = out.begin() + static_cast<std::ptrdiff_t>(next[a]);
    std::sort(from, to, [](const Side& x, const Side& y) {
      return std::tie(x.b, x.triangle) < std::tie(y.b, y.triangle);
    });
    begin = next[a];
  }
  return out;
}

/// Normals that differ by more (rad) are those of an edge.
constexpr double kSmooth = 1e-3;

/// Normals at the ends of a side, in the order of its corners' numbers.
std::array<Vec3, 2> normals_of(const std::vector<Mesh>& meshes, const FieldTriangle& t,
                               const std::vector<std::uint32_t>& corner, const Side& side) {
  const Mesh& mesh = meshes[t.mesh];
  const auto normal = [&](std::uint32_t k) {
    return mesh.vertices[mesh.triangles[t.number][k]].normal;
  };
  const std::uint32_t k = side.edge, next = (side.edge + 1) % 3;
  std::array<Vec3, 2> out{normal(k), normal(next)};
  if (corner[3 * side.triangle + k] != side.a) std::swap(out[0], out[1]);
  return out;
}

bool smooth(const std::array<Vec3, 2>& one, const std::array<Vec3, 2>& two) {
  for (std::size_t k = 0; k < 2; ++k) {  // patches may look either way
    if (norm(cross(one[k], two[k])) > kSmooth) return false;
  }
  return true;
}

/// Upwards, length 1; none for triangles that stand upright.
Vec3 up_normal(const Triangle& t) {
  constexpr double kUpright = 1e-6;  // z of normals
  const Vec3 n = unit(cross(t[1] - t[0], t[2] - t[0]));
  if (std::abs(n.z) < kUpright) return {};
  return n.z < 0.0 ? -n : n;
}

/// Two triangles at a side that rise away from it on both its sides.
bool valley(const LargeList<FieldTriangle>& triangles, const Side& one, const Side& two) {
  const Triangle& t = triangles[one.triangle].corners;
  const Vec3 n = up_normal(t);
  if (n == Vec3{} || up_normal(triangles[two.triangle].corners) == Vec3{}) return false;
  const Vec3 a = t[one.edge], b = t[(one.edge + 1) % 3];
  const Vec3 here = t[(one.edge + 2) % 3];
  const Vec3 there = triangles[two.triangle].corners[(two.edge + 2) % 3];
  const auto beside = [&](Vec3 p) {
    return cross(Vec2{b.x - a.x, b.y - a.y}, Vec2{p.x - a.x, p.y - a.y});
  };
  return beside(here) * beside(there) < 0.0 && dot(n, there - a) > 0.0;
}

void set_bit(std::uint8_t& bits, std::uint32_t bit) {
  bits = static_cast<std::uint8_t>(bits | (1U << bit));
}

/// What the triangles at one side say of it.
class SideMarker {
 public:
  SideMarker(const std::vector<Mesh>& meshes, LargeList<FieldTriangle>& triangles,
             const std::vector<std::uint32_t>& corner)
      : meshes_(meshes),
        triangles_(triangles),
        corner_(corner),
        at_border_(corner.size(), false),
        ridge_(corner.size(), false) {}

  void mark(std::span<const Side> sides) {
    const Side& first = sides.front();
    if (first.a == first.b) return;  // a side without length
    const bool pair = sides.size() == 2;
    const bool bottom = pair && valley(triangles_, sides[0], sides[1]);
    const bool rough =
        !pair || !smooth(normals_of(meshes_, triangles_[sides[0].triangle], corner_, sides[0]),
                         normals_of(meshes_, triangles_[sides[1].triangle], corner_, sides[1]));
    if (sides.size() == 1) {
      set_bit(triangles_[first.triangle].open, 1 + first.edge);
      at_border_[first.a] = at_border_[first.b] = true;
    }
    if (!bottom) ridge_[first.a] = ridge_[first.b] = true;
    for (std::size_t k = 0; k < sides.size(); ++k) {
      FieldTriangle& t = triangles_[sides[k].triangle];
      t.rough = t.rough || rough;
      if (bottom || k > 0) set_bit(t.skipped, 1 + sides[k].edge);
    }
  }

  void mark_corners() {
    std::vector<bool> taken(corner_.size(), false);
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t number = corner_[3 * i + k];
        if (at_border_[number]) set_bit(triangles_[i].open, 4 + k);
        if (taken[number] || !ridge_[number]) set_bit(triangles_[i].skipped, 4 + k);
        taken[number] = true;
      }
    }
  }

 private:
  const std::vector<Mesh>& meshes_;
  LargeList<FieldTriangle>& triangles_;
  const std::vector<std::uint32_t>& corner_;
  std::vector<bool> at_border_, ridge_;
};

}  // namespace

void mark_sides(const std::vector<Mesh>& meshes, LargeList<FieldTriangle>& triangles) {
  const auto corner = corner_numbers(meshes, triangles);
  const auto sides = sides_in_order(corner);
  SideMarker marker(meshes, triangles, corner);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].same(sides[i])) ++end;
    marker.mark(std::span(sides).subspan(i, end - i));
    i = end;
  }
  marker.mark_corners();
}

}  // namespace obvid::toolpath
