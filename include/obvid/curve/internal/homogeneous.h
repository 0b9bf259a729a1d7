// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Point of projective space: coordinates times weight, and the weight. Points of the plane have
/// z = 0.
struct Vec4 {
  double x = 0.0, y = 0.0, z = 0.0, w = 0.0;

  friend Vec4 operator+(const Vec4& a, const Vec4& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w};
  }
  friend Vec4 operator*(double s, const Vec4& a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
};

/// a at part 0, b at part 1, exactly.
inline Vec4 between(const Vec4& a, const Vec4& b, double part) {
  return (1.0 - part) * a + part * b;
}

inline Vec4 lifted(Vec3 p, double w) { return {w * p.x, w * p.y, w * p.z, w}; }
inline Vec4 lifted(Vec2 p, double w) { return {w * p.x, w * p.y, 0.0, w}; }

/// The coordinates still times the weight.
template <class V = Vec3>
V numerator(const Vec4& a);
template <>
inline Vec3 numerator<Vec3>(const Vec4& a) {
  return {a.x, a.y, a.z};
}
template <>
inline Vec2 numerator<Vec2>(const Vec4& a) {
  return {a.x, a.y};
}
template <class V = Vec3>
V dropped(const Vec4& a) {
  return numerator<V>(a) / a.w;
}

template <class V>
Vec4 lifted(const std::vector<V>& points, const std::vector<double>& weights, std::size_t i) {
  return lifted(points[i], weights.empty() ? 1.0 : weights[i]);
}

/// Control points of one line of a curve or surface.
using Polygon = std::vector<Vec4>;

template <class V>
Polygon lifted(const std::vector<V>& points, const std::vector<double>& weights) {
  Polygon polygon(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) polygon[i] = lifted(points, weights, i);
  return polygon;
}

}  // namespace obvid
