// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/arcs_over_chord.h"

#include <algorithm>
#include <cmath>

namespace obvid {
namespace {

/// Where the ray foot + s way, s > 0, first meets the circle (or line) through `at` with this unit
/// tangent: the root of k |p - at|^2 = 2 (p - at) . normal of smaller size.
double first_meeting(Vec2 foot, Vec2 way, Vec2 at, Vec2 tangent, double kappa) {
  const Vec2 v = foot - at, normal = left_normal(tangent);
  const double a = kappa * dot(way, way), half = kappa * dot(v, way) - dot(way, normal);
  const double c = kappa * dot(v, v) - 2.0 * dot(v, normal);
  const double root = std::sqrt(std::max(0.0, half * half - a * c));
  return -c / (half + std::copysign(root, half));
}

/// Whether a line through the chord meets a boundary beyond the joint of its arcs.
bool meets_beyond_joint(const ChordFrame& f, const Boundary& b, Vec2 foot, Vec2 way) {
  const double x = joint_abscissa(f, b.kappa_first, b.kappa_second, b.joint_tangent);
  const Vec2 along = f.start_tangent + b.joint_tangent;  // the chord of the first arc
  return cross(way, x / along.x * along - foot) * way.y > 0.0;
}

}  // namespace

double half_turn_sine_squared(const ChordFrame& f) {
  const Vec2 turn = complex_product(f.start_tangent, f.end_tangent);  // e^{i sigma}
  return turn.x > 0.0 ? turn.y * turn.y / (2.0 * (1.0 + turn.x)) : 0.5 * (1.0 - turn.x);
}

Vec2 joint_tangent(const ChordFrame& f, double k0, double k1) {
  const double a = 0.5 * k0 * f.h, b = 0.5 * k1 * f.h;
  if (std::isinf(a)) return b == 0.0 ? f.end_tangent : Vec2{f.end_tangent.x, -f.end_tangent.y};
  if (std::isinf(b)) return Vec2{f.start_tangent.x, -f.start_tangent.y};
  // (b - a) e^{i theta} = 2 i a b + b e^{i alpha} - a e^{i beta}
  const Vec2 v = Vec2{0.0, 2.0 * a * b} + b * f.start_tangent - a * f.end_tangent;
  const Vec2 w = b > a ? v : -v;
  const double length = norm(w);
  return length > 0.0 ? w / length : f.start_tangent;
}

double joint_abscissa(const ChordFrame& f, double first, double second, Vec2 tangent) {
  // from the arc that bends more
  const double x = std::abs(first) >= std::abs(second)
                       ? (tangent.y - f.start_tangent.y) / first
                       : f.h - (f.end_tangent.y - tangent.y) / second;
  return std::clamp(x, 0.0, f.h);
}

std::optional<double> part_of_median(const ChordFrame& f, const Boundary& b, Vec2 apex) {
  const Vec2 foot = {0.5 * f.h, 0.0}, way = apex - foot;
  const bool no_first = std::isinf(b.kappa_first), no_second = std::isinf(b.kappa_second);
  const bool turns_away = (!no_first && !(f.start_tangent.x > 0.0)) ||
                          (!no_second && !(f.end_tangent.x > 0.0)) ||
                          (!no_first && !no_second && !(b.joint_tangent.x > 0.0));
  if (turns_away) return std::nullopt;
  const bool first = no_second || (!no_first && !meets_beyond_joint(f, b, foot, way));
  if (first) return first_meeting(foot, way, {0.0, 0.0}, f.start_tangent, b.kappa_first);
  return first_meeting(foot, way, {f.h, 0.0}, f.end_tangent, b.kappa_second);
}

}  // namespace obvid
