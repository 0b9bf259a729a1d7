// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "dxf/entity_shape.h"
#include "obvid/core/units.h"

namespace obvid::dxf {
namespace {

Point3 cross3(Point3 a, Point3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Point3 unit(Point3 a) {
  const double length = std::hypot(a.x, a.y, a.z);
  return {a.x / length, a.y / length, a.z / length};
}

}  // namespace

Affine operator*(const Affine& second, const Affine& first) {
  Affine out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) sum += second.linear[i][k] * first.linear[k][j];
      out.linear[i][j] = sum;
    }
  }
  out.shift = apply(second, first.shift);
  return out;
}

Point3 apply(const Affine& map, Point3 p) {
  const auto row = [&](std::size_t i) {
    return map.linear[i][0] * p.x + map.linear[i][1] * p.y + map.linear[i][2] * p.z;
  };
  return {row(0) + map.shift.x, row(1) + map.shift.y, row(2) + map.shift.z};
}

Affine plane_to_space(Point3 normal) {
  // The x axis is level: along Y x N near the z axis, Z x N elsewhere. 1/64 is part of the format.
  constexpr double kNear = 1.0 / 64.0;
  if (normal.x == 0.0 && normal.y == 0.0 && normal.z > 0.0) return {};
  const Point3 n = unit(normal);
  const bool near = std::abs(n.x) < kNear && std::abs(n.y) < kNear;
  const Point3 x = unit(cross3(near ? Point3{0, 1, 0} : Point3{0, 0, 1}, n));
  const Point3 y = unit(cross3(n, x));
  Affine out;
  out.linear = {{{x.x, y.x, n.x}, {x.y, y.y, n.y}, {x.z, y.z, n.z}}};
  return out;
}

Affine scaling(Point3 factors) {
  Affine out;
  out.linear = {{{factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}}};
  return out;
}

Affine translation(Point3 by) {
  Affine out;
  out.shift = by;
  return out;
}

Affine rotation(double degrees) {
  if (degrees == 0.0) return {};
  const double angle = std::fmod(degrees, 360.0) * kOneDegree;
  Affine out;
  out.linear[0] = {std::cos(angle), -std::sin(angle), 0.0};
  out.linear[1] = {std::sin(angle), std::cos(angle), 0.0};
  return out;
}

}  // namespace obvid::dxf
