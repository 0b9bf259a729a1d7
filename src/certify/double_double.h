// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/numeric/internal/strict_arithmetic.h"

namespace obvid {
namespace {  // see strict_arithmetic.h

/// Unit roundoff of double.
inline constexpr double kUnitRoundoff = 0x1p-53;

/// Unevaluated sum hi + lo of two doubles, |lo| <= ulp(hi)/2: about 106 bits.
struct DoubleDouble {
  double hi = 0.0;
  double lo = 0.0;
};

/// Relative error of one operation below is at most this, 8 u^2. (Joldes, Muller, Popescu 2017:
/// sum at most 3 u^2 + 13 u^3, product without fma at most 7 u^2 + O(u^3), product with a double
/// at most 3 u^2; barring underflow.)
inline constexpr double kDoubleDoubleRoundoff = 8.0 * kUnitRoundoff * kUnitRoundoff;

/// a + b exactly ([Knuth 1997]).
[[nodiscard]] constexpr DoubleDouble two_sum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

/// a + b exactly when |a| >= |b| (Dekker).
[[nodiscard]] constexpr DoubleDouble quick_two_sum(double a, double b) {
  const double s = a + b;
  return {s, b - (s - a)};
}

/// a * b exactly for factors below 2^995 whose product does not underflow (Dekker, Veltkamp).
/// Written without fma: a build for a processor without one would call a slow routine.
[[nodiscard]] constexpr DoubleDouble two_product(double a, double b) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1 cuts 53 bits into 26 + 26
  const double p = a * b;
  const double ca = kSplitter * a;
  const double a_hi = ca - (ca - a);
  const double a_lo = a - a_hi;
  const double cb = kSplitter * b;
  const double b_hi = cb - (cb - b);
  const double b_lo = b - b_hi;
  return {p, ((a_hi * b_hi - p) + a_hi * b_lo + a_lo * b_hi) + a_lo * b_lo};
}

/// "AccurateDWPlusDW".
[[nodiscard]] constexpr DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble s = two_sum(a.hi, b.hi);
  const DoubleDouble t = two_sum(a.lo, b.lo);
  const DoubleDouble v = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(v.hi, t.lo + v.lo);
}

[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a) { return {-a.hi, -a.lo}; }
[[nodiscard]] constexpr DoubleDouble operator-(DoubleDouble a, DoubleDouble b) { return a + (-b); }

/// "DWTimesDW1".
[[nodiscard]] constexpr DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble p = two_product(a.hi, b.hi);
  return quick_two_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/// Product with a small integer.
[[nodiscard]] constexpr DoubleDouble operator*(DoubleDouble a, int factor) {
  const DoubleDouble p = two_product(a.hi, static_cast<double>(factor));
  return quick_two_sum(p.hi, p.lo + a.lo * static_cast<double>(factor));
}

}  // namespace
}  // namespace obvid
