// SPDX-License-Identifier: Apache-2.0
#include "drop_triangle.h"

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {
namespace {

/// Triangles that stand upright within this (z of the unit normal) touch with edges only.
constexpr double kUprightTriangle = 1e-9;
constexpr int kHalvings = 40;  // of the part of an edge under the cutter: below rounding

bool raise(Rest& rest, double tip_z, Vec3 point, int feature) {
  if (!(tip_z > rest.tip_z)) return false;
  rest = {tip_z, point, feature};
  return true;
}

bool on_corner(const CutterShape& cutter, Vec2 axis, Vec3 p, int feature, Rest& rest) {
  if (p.z <= rest.tip_z) return false;
  const double d = std::hypot(p.x - axis.x, p.y - axis.y);
  return d <= cutter.radius && raise(rest, p.z - cutter.height(d), p, feature);
}

/// Along a straight line that passes the axis at distance `e`, height z0 + slope s: the s within
/// [from, to] where a coming cutter touches. The gap is convex in s, so one place is lowest.
double touching(const CutterShape& cutter, double e, double slope, double from, double to) {
  if (cutter.corner <= 0.0) return slope > 0.0 ? to : from;
  if (cutter.flat() <= 0.0) {  // a ball is cut in a circle
    const double r2 = std::max(0.0, cutter.corner * cutter.corner - e * e);
    return std::clamp(std::sqrt(r2) * slope / std::sqrt(1.0 + slope * slope), from, to);
  }
  const auto rises = [&](double s) {  // the line's slope beats that of the cutter
    const double d = std::hypot(s, e), out = d - cutter.flat();
    if (out <= 0.0) return slope > 0.0;
    const double side = std::sqrt(std::max(0.0, cutter.corner * cutter.corner - out * out));
    return slope * side * d > out * s;
  };
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (from + to);
    (rises(middle) ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

bool on_edge(const CutterShape& cutter, Vec2 axis, Vec3 a, Vec3 b, int feature, Rest& rest) {
  if (std::max(a.z, b.z) <= rest.tip_z) return false;
  const Vec2 way{b.x - a.x, b.y - a.y}, to{axis.x - a.x, axis.y - a.y};
  const double length = norm(way);
  if (!(length > 0.0)) return false;  // upright: the corners say it
  const double e = std::abs(cross(way, to)) / length;
  if (e >= cutter.radius) return false;
  const double foot = dot(way, to) / length;
  const double half = std::sqrt(cutter.radius * cutter.radius - e * e);
  const double from = std::max(-foot, -half), end = std::min(length - foot, half);
  if (!(from < end)) return false;
  const double slope = (b.z - a.z) / length;
  const double s = touching(cutter, e, slope, from, end);
  const double part = std::clamp((s + foot) / length, 0.0, 1.0);
  const Vec3 p = a + part * (b - a);
  return raise(rest, p.z - cutter.height(std::hypot(s, e)), p, feature);
}

bool inside(const Triangle& t, Vec2 p, std::array<double, 3>& w) {
  const Vec2 a{t[0].x, t[0].y}, b{t[1].x, t[1].y}, c{t[2].x, t[2].y};
  const double area = cross(b - a, c - a);
  if (area == 0.0) return false;
  w[1] = cross(p - a, c - a) / area;
  w[2] = cross(b - a, p - a) / area;
  w[0] = 1.0 - w[1] - w[2];
  return w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0;
}

bool on_inside(const CutterShape& cutter, Vec2 axis, const Triangle& t, Rest& rest) {
  Vec3 n = unit(cross(t[1] - t[0], t[2] - t[0]));
  if (std::abs(n.z) < kUprightTriangle) return false;
  if (n.z < 0.0) n = -n;
  const Vec2 touch = axis - cutter.offset(n);
  std::array<double, 3> w{};
  if (!inside(t, touch, w)) return false;
  const Vec3 p = w[0] * t[0] + w[1] * t[1] + w[2] * t[2];
  return raise(rest, p.z + cutter.corner * (n.z - 1.0), p, 0);
}

}  // namespace

bool drop_on(const CutterShape& cutter, Vec2 axis, const Triangle& t, Rest& rest) {
  bool raised = on_inside(cutter, axis, t, rest);
  for (std::size_t k = 0; k < 3; ++k) {
    const int edge = static_cast<int>(k) + 1;
    raised = on_edge(cutter, axis, t[k], t[(k + 1) % 3], edge, rest) || raised;
    raised = on_corner(cutter, axis, t[k], edge + 3, rest) || raised;
  }
  return raised;
}

bool height_over(const Triangle& t, Vec2 place, double& z, std::array<double, 3>& w) {
  if (!inside(t, place, w)) return false;
  z = w[0] * t[0].z + w[1] * t[1].z + w[2] * t[2].z;
  return true;
}

}  // namespace obvid::toolpath
