// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cmath>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Point or vector of space, in model units.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return s * a; }
  friend constexpr Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }
  friend constexpr bool operator==(Vec3 a, Vec3 b) = default;
};

[[nodiscard]] constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }
/// Vector of length 1 in the direction of a; a itself when it is zero.
[[nodiscard]] inline Vec3 unit(Vec3 a) {
  const double length = norm(a);
  return length > 0.0 ? a / length : a;
}
[[nodiscard]] inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// A plane in space with right-handed coordinates: `x` and `y` have length 1 and are perpendicular.
struct Frame {
  Vec3 origin;
  Vec3 x{1.0, 0.0, 0.0};
  Vec3 y{0.0, 1.0, 0.0};

  [[nodiscard]] constexpr Vec3 normal() const { return cross(x, y); }
  [[nodiscard]] constexpr Vec3 direction(Vec2 a) const { return a.x * x + a.y * y; }
  [[nodiscard]] constexpr Vec3 at(Vec2 a) const { return origin + direction(a); }
  [[nodiscard]] constexpr Vec2 in_plane(Vec3 p) const {
    return {dot(p - origin, x), dot(p - origin, y)};
  }
  [[nodiscard]] constexpr double height(Vec3 p) const { return dot(p - origin, normal()); }
};

}  // namespace obvid
