// SPDX-License-Identifier: Apache-2.0
#include "drop_triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace obvid::toolpath {
namespace {

/// Triangles that stand upright within this (z of the unit normal) touch with edges only.
constexpr double kUprightTriangle = 1e-9;
constexpr double kLeaning = 1e-4;         // z of the unit normal
constexpr double kSurelyIn = 1e-6;        // weight of a place on the inner side of a side
constexpr int kMostEdgeSteps = 60;        // along an edge: below rounding
constexpr int kHalvedEach = 3;            // of these steps one halves what is left
constexpr double kSecantOnEdge = 0.02;    // of what is left: others keep that far from its ends
constexpr double kSettledOnEdge = 1e-12;  // of the radius

double level_length(double x, double y) { return std::sqrt(x * x + y * y); }

bool raise_rest(Rest& rest, double tip_z, Vec3 point, int feature) {
  if (!(tip_z > rest.tip_z)) return false;
  rest = {tip_z, point, feature};
  return true;
}

bool on_corner(const CutterShape& cutter, Vec2 axis, Vec3 p, int feature, Rest& rest) {
  if (p.z <= rest.tip_z) return false;
  const double d = level_length(p.x - axis.x, p.y - axis.y);
  return d <= cutter.radius && raise_rest(rest, p.z - cutter.height(d), p, feature);
}

/// An edge seen from the axis: it passes at distance `beside`; height over `s` along it.
struct EdgeLine {
  double beside, slope, height;  ///< height: at s = 0
  struct Tip {
    double z, change;  ///< of the tip that touches at s; concave in s
  };
  [[nodiscard]] Tip tip(const CutterShape& cutter, double s) const {
    const double d = level_length(s, beside), out = d - cutter.flat();
    if (out <= 0.0) return {height + slope * s, slope};
    const double side = std::sqrt(std::max(0.0, cutter.corner * cutter.corner - out * out));
    const double steep = side > 0.0 ? out / side : std::numeric_limits<double>::infinity();
    return {height + slope * s - (cutter.corner - side), slope - (s == 0.0 ? 0.0 : steep * s / d)};
  }
};

/// The s within [from, to] where a coming cutter touches; `enough`: tips up to there are of no
/// interest, false then.
bool touching(const CutterShape& cutter, const EdgeLine& edge, double from, double to,
              double enough, double& s) {
  if (cutter.corner <= 0.0) {
    s = edge.slope > 0.0 ? to : from;
    return true;
  }
  if (cutter.flat() <= 0.0) {  // a ball is cut in a circle
    const double r2 = std::max(0.0, cutter.corner * cutter.corner - edge.beside * edge.beside);
    s = std::clamp(std::sqrt(r2) * edge.slope / std::sqrt(1.0 + edge.slope * edge.slope), from, to);
    return true;
  }
  // the tip's height is concave: its change falls from end to end, tangents lie above it
  const double settled = kSettledOnEdge * cutter.radius;
  double rises = std::numeric_limits<double>::infinity(), falls = -rises;  // changes at the ends
  for (int k = 0; k < kMostEdgeSteps && to - from > settled; ++k) {
    const double part =
        k % kHalvedEach != 0 && std::isfinite(rises - falls)
            ? std::clamp(rises / (rises - falls), kSecantOnEdge, 1.0 - kSecantOnEdge)
            : 0.5;
    s = from + part * (to - from);
    const EdgeLine::Tip at = edge.tip(cutter, s);
    const double left = at.change > 0.0 ? to - s : s - from;
    if (at.z + std::abs(at.change) * left <= enough) return false;
    if (std::abs(at.change) * left <= settled) return true;
    (at.change > 0.0 ? from : to) = s;
    (at.change > 0.0 ? rises : falls) = at.change;
  }
  s = 0.5 * (from + to);
  return true;
}

bool on_edge(const CutterShape& cutter, Vec2 axis, Vec3 a, Vec3 b, int feature, Rest& rest) {
  if (std::max(a.z, b.z) <= rest.tip_z) return false;
  const Vec2 way{b.x - a.x, b.y - a.y}, to{axis.x - a.x, axis.y - a.y};
  const double length = norm(way);
  if (!(length > 0.0)) return false;  // upright: the corners say it
  const double e = std::abs(cross(way, to)) / length;
  if (e >= cutter.radius || std::max(a.z, b.z) - cutter.height(e) <= rest.tip_z) return false;
  const double foot = dot(way, to) / length;
  const double half = std::sqrt(cutter.radius * cutter.radius - e * e);
  const double from = std::max(-foot, -half), end = std::min(length - foot, half);
  if (!(from < end)) return false;
  const double slope = (b.z - a.z) / length;
  double s = 0.0;
  if (!touching(cutter, {e, slope, a.z + slope * foot}, from, end, rest.tip_z, s)) return false;
  const double part = std::clamp((s + foot) / length, 0.0, 1.0);
  const Vec3 p = a + part * (b - a);
  return raise_rest(rest, p.z - cutter.height(level_length(s, e)), p, feature);
}

/// The weights of a place; false: it lies outside.
bool inside(const Triangle& t, Vec2 p, std::array<double, 3>& w) {
  const Vec2 a{t[0].x, t[0].y}, b{t[1].x, t[1].y}, c{t[2].x, t[2].y};
  const double area = cross(b - a, c - a);
  if (area == 0.0) {
    w.fill(-1.0);
    return false;
  }
  w[1] = cross(p - a, c - a) / area;
  w[2] = cross(b - a, p - a) / area;
  w[0] = 1.0 - w[1] - w[2];
  return w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0;
}

/// The whole plane of a triangle under a cutter.
struct PlaneRest {
  double tip_z;  ///< no feature of the triangle holds the tip any higher
  Vec2 touch;    ///< from the axis
  bool leans;    ///< so far from upright that weights of its places are known
};

std::optional<PlaneRest> on_plane(const CutterShape& cutter, Vec2 axis, const Triangle& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double level2 = n.x * n.x + n.y * n.y, size = std::sqrt(level2 + n.z * n.z);
  if (!(std::abs(n.z) >= kUprightTriangle * size) || !(size > 0.0)) return std::nullopt;
  const double level = std::sqrt(level2), up = std::abs(n.z), side = n.z < 0.0 ? -1.0 : 1.0;
  const double plane = t[0].z - (n.x * (axis.x - t[0].x) + n.y * (axis.y - t[0].y)) / n.z;
  const double lift = cutter.corner * (size / up - 1.0) + cutter.flat() * level / up;
  const double out = cutter.corner / size + (level > 0.0 ? cutter.flat() / level : 0.0);
  return PlaneRest{plane + lift, -side * out * Vec2{n.x, n.y}, up > kLeaning * size};
}

}  // namespace

// Over a plane the height of the tip that touches at a place is concave, with its greatest value
// where the plane would be touched. From the highest place of the triangle it grows on the way
// there, so that way leads out at once: sides that it does not cross need not be looked at.
bool drop_on(const CutterShape& cutter, Vec2 axis, const Triangle& t, unsigned skipped,
             Rest& rest) {
  std::array<bool, 3> beyond = {true, true, true};  // the sides t[k], t[k + 1]
  if (const auto plane = on_plane(cutter, axis, t)) {
    if (plane->tip_z <= rest.tip_z) return false;
    std::array<double, 3> w{};
    if (inside(t, axis + plane->touch, w)) {
      return raise_rest(rest, plane->tip_z, w[0] * t[0] + w[1] * t[1] + w[2] * t[2], 0);
    }
    for (std::size_t k = 0; plane->leans && k < 3; ++k) beyond[k] = !(w[(k + 2) % 3] > kSurelyIn);
  }
  bool raised = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int edge = static_cast<int>(k) + 1;
    if (beyond[k] && ((skipped >> edge) & 1U) == 0) {
      raised = on_edge(cutter, axis, t[k], t[(k + 1) % 3], edge, rest) || raised;
    }
    if ((beyond[k] || beyond[(k + 2) % 3]) && ((skipped >> (edge + 3)) & 1U) == 0) {
      raised = on_corner(cutter, axis, t[k], edge + 3, rest) || raised;
    }
  }
  return raised;
}

bool height_over(const Triangle& t, Vec2 place, double& z, std::array<double, 3>& w) {
  // on a side two triangles share a place, whatever rounding says of each
  constexpr double kOnSide = 1e-9;  // of the triangle
  inside(t, place, w);
  if (!(std::min({w[0], w[1], w[2]}) >= -kOnSide)) return false;
  z = w[0] * t[0].z + w[1] * t[1].z + w[2] * t[2].z;
  return true;
}

}  // namespace obvid::toolpath
