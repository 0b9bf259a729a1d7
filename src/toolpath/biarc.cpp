// SPDX-License-Identifier: Apache-2.0
#include "biarc.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid::toolpath {
namespace {

constexpr double kParallel = 1e-12;  // 1 - cosine of tangents that count as parallel
constexpr double kStraight = 1e-9;   // sine of the angle between tangent and chord

}  // namespace

std::optional<Vec2> biarc_joint(Vec2 from, Vec2 leaving, Vec2 to, Vec2 arriving) {
  const Vec2 way = to - from, sum = leaving + arriving;
  const double a = 2.0 * (1.0 - dot(leaving, arriving)), b = dot(way, sum), c = dot(way, way);
  if (!(b > 0.0) || !(c > 0.0)) return std::nullopt;
  const double length = a > kParallel ? (std::sqrt(b * b + a * c) - b) / a : c / (2.0 * b);
  const Vec2 joint = 0.5 * (from + to + length * (leaving - arriving));
  const bool forwards = dot(joint - from, leaving) > 0.0 && dot(to - joint, arriving) > 0.0;
  return forwards ? std::optional<Vec2>(joint) : std::nullopt;
}

// The middle lies over the chord's by length / 2 * tan(angle / 2), on the side that it leaves to.
Vec2 arc_middle(Vec2 from, Vec2 leaving, Vec2 to) {
  const Vec2 chord = to - from;
  const double angle = turning(chord, leaving);
  return from + 0.5 * chord + 0.5 * std::tan(0.5 * angle) * left_normal(chord);
}

double distance_from_arc(Vec2 from, Vec2 leaving, Vec2 to, Vec2 point) {
  const Vec2 chord = to - from;
  const double length = norm(chord), sine = cross(leaving, chord) / length;
  const double along = dot(point - from, chord) / length;
  const double ends = std::min(norm(point - from), norm(point - to));
  if (std::abs(sine) < kStraight) {
    return along < 0.0 || along > length ? ends : std::abs(cross(point - from, chord)) / length;
  }
  const double radius = length / (2.0 * sine);  // to the left: positive
  const Vec2 centre = from + radius * left_normal(leaving);
  const Vec2 a = from - centre, b = to - centre, p = point - centre;
  const double side = radius > 0.0 ? 1.0 : -1.0;
  const bool between = side * cross(a, p) >= 0.0 && side * cross(p, b) >= 0.0;
  return between ? std::abs(norm(p) - std::abs(radius)) : ends;
}

}  // namespace obvid::toolpath
