// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Where the chord from a to b is nearest to p: 0 at a, 1 at b; 0 where it has no length.
template <class Point>
[[nodiscard]] inline double part_of_chord(const Point& p, const Point& a, const Point& b) {
  const Point chord = b - a;
  const double square = dot(chord, chord);
  return square > 0.0 ? std::clamp(dot(p - a, chord) / square, 0.0, 1.0) : 0.0;
}

/// How far p is from the chord from a to b.
template <class Point>
[[nodiscard]] inline double distance_from_chord(const Point& p, const Point& a, const Point& b) {
  return norm(p - a - part_of_chord(p, a, b) * (b - a));
}

}  // namespace obvid
