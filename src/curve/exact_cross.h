// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "obvid/geom/vec2.h"

namespace obvid::curve_detail {

/// Unevaluated sum of two doubles: some 106 bits. (The certifier has arithmetic of its own: a proof
/// shares nothing with what builds a piece.)
struct Twofold {
  double hi = 0.0, lo = 0.0;
};

[[nodiscard]] inline Twofold sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

[[nodiscard]] inline Twofold product(double a, double b) {
  const double p = a * b;
  return {p, std::fma(a, b, -p)};
}

[[nodiscard]] inline Twofold operator+(Twofold a, Twofold b) {
  const Twofold s = sum(a.hi, b.hi), t = sum(a.lo, b.lo);
  const Twofold v = sum(s.hi, s.lo + t.hi);
  return sum(v.hi, t.lo + v.lo);
}

[[nodiscard]] inline Twofold operator-(Twofold a) { return {-a.hi, -a.lo}; }

[[nodiscard]] inline Twofold operator*(Twofold a, Twofold b) {
  const Twofold p = product(a.hi, b.hi);
  return sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// A difference of points, exactly.
struct Leg {
  Twofold x, y;
};

[[nodiscard]] inline Leg leg(Vec2 from, Vec2 to) {
  return {sum(to.x, -from.x), sum(to.y, -from.y)};
}

[[nodiscard]] inline Vec2 rounded(const Leg& l) { return {l.x.hi, l.y.hi}; }

[[nodiscard]] inline Twofold cross(const Leg& a, const Leg& b) { return a.x * b.y + -(a.y * b.x); }

}  // namespace obvid::curve_detail
