// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cmath>

#include "obvid/core/internal/always_inline.h"

namespace obvid {

/// Point or vector of the plane, in model units. Its arithmetic is written into every function that
/// uses it, so that no other object file, compiled with options of its own, can take its place.
struct Vec2 {
  double x = 0.0;
  double y = 0.0;

  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator+(Vec2 a, Vec2 b) {
    return {a.x + b.x, a.y + b.y};
  }
  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator-(Vec2 a, Vec2 b) {
    return {a.x - b.x, a.y - b.y};
  }
  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator*(double s, Vec2 a) {
    return {s * a.x, s * a.y};
  }
  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator*(Vec2 a, double s) {
    return {s * a.x, s * a.y};
  }
  OBVID_ALWAYS_INLINE friend constexpr Vec2 operator/(Vec2 a, double s) {
    return {a.x / s, a.y / s};
  }
  friend constexpr bool operator==(Vec2 a, Vec2 b) = default;
};

[[nodiscard]] OBVID_ALWAYS_INLINE constexpr double dot(Vec2 a, Vec2 b) {
  return a.x * b.x + a.y * b.y;
}
/// z component of the cross product; positive when b lies to the left of a.
[[nodiscard]] OBVID_ALWAYS_INLINE constexpr double cross(Vec2 a, Vec2 b) {
  return a.x * b.y - a.y * b.x;
}
[[nodiscard]] OBVID_ALWAYS_INLINE inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] OBVID_ALWAYS_INLINE constexpr Vec2 left_normal(Vec2 a) { return {-a.y, a.x}; }
[[nodiscard]] OBVID_ALWAYS_INLINE inline bool is_finite(Vec2 a) {
  return std::isfinite(a.x) && std::isfinite(a.y);
}
/// Heading of a vector in (-pi, pi].
[[nodiscard]] OBVID_ALWAYS_INLINE inline double heading(Vec2 a) { return std::atan2(a.y, a.x); }
[[nodiscard]] OBVID_ALWAYS_INLINE inline Vec2 unit_at(double theta) {
  return {std::cos(theta), std::sin(theta)};
}
/// Angle that turns a into b, in (-pi, pi].
[[nodiscard]] OBVID_ALWAYS_INLINE inline double turning(Vec2 a, Vec2 b) {
  return std::atan2(cross(a, b), dot(a, b));
}
/// Product of two plane vectors read as complex numbers: rotates and scales a by b.
[[nodiscard]] OBVID_ALWAYS_INLINE constexpr Vec2 complex_product(Vec2 a, Vec2 b) {
  return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
}

}  // namespace obvid
