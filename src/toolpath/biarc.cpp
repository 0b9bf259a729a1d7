// SPDX-License-Identifier: Apache-2.0
#include "biarc.h"

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {
namespace {

constexpr double kParallel = 1e-12;  // 1 - cosine of tangents that count as parallel

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

}  // namespace obvid::toolpath
