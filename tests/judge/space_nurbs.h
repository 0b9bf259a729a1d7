// SPDX-License-Identifier: Apache-2.0
// Curves in space in long double, NURBS by the recursion of Cox and de Boor as it stands.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "json_text.h"
#include "real_curve.h"

namespace judge {

struct Vec3 {
  Real x = 0.0L, y = 0.0L, z = 0.0L;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Real k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
inline Real dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// Throw std::runtime_error where the value is no [x, y, z], or no list of them.
Vec3 vec3_of(const Json& json);
std::vector<Vec3> vec3s_of(const Json& json);

/// Largest distance from the first point.
Real extent_of(const std::vector<Vec3>& points);
Real largest_coordinate(const std::vector<Vec3>& points);

/// Point with derivatives by any parameter.
struct SpaceJet {
  Vec3 p, d, dd, ddd;

  [[nodiscard]] Real curvature() const {
    const Real speed = norm(d);
    return norm(cross(d, dd)) / (speed * speed * speed);
  }
  /// Right-handed positive; not finite where the curvature is 0.
  [[nodiscard]] Real torsion() const {
    const Vec3 b = cross(d, dd);
    return dot(b, ddd) / dot(b, b);
  }
};

struct SpaceNurbs {
  int degree = 0;
  std::vector<Real> knots, weights;
  std::vector<Vec3> points;

  /// What is wrong with the numbers; empty: nothing.
  [[nodiscard]] std::string fault() const;
  /// Basis function i, or its derivative of some order; at a knot from the right, at the end of the
  /// domain from the left.
  [[nodiscard]] Real basis(std::size_t i, Real u, int order = 0) const;
  [[nodiscard]] SpaceJet at(Real u) const;
  [[nodiscard]] Real from() const { return knots.front(); }
  [[nodiscard]] Real to() const { return knots.back(); }

 private:
  [[nodiscard]] std::size_t span_of(Real u) const;
  [[nodiscard]] Real basis(std::size_t i, int of_degree, Real u, std::size_t span, int order) const;
};
/// An object with degree, knots, points and weights (none: all 1).
SpaceNurbs nurbs_of(const Json& json);

}  // namespace judge
