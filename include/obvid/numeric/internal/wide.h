// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "obvid/numeric/internal/double_double.h"

namespace obvid::numeric {

/// A number of 106 bits, the same on every machine (`long double` has 53, 64 or 113 bits,
/// depending on machine and compiler).
///
/// Relative errors, u = 2^-53, where nothing leaves the range 1e-290 to 1e290: at most
/// `kDoubleDoubleRoundoff` of a sum, difference or product, and 15 u^2 + 56 u^3 of a quotient
/// (Joldes, Muller, Popescu: "Tight and rigorous error bounds for basic building blocks of
/// double-word arithmetic", ACM TOMS 44, 2017).
class Wide {
 public:
  Wide() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): a double is such a number
  constexpr Wide(double value) : value_{value, 0.0} {}

  /// Every whole number of 64 bits is one, exactly.
  [[nodiscard]] static constexpr Wide whole(std::int64_t value) {
    constexpr std::int64_t kHalf = std::int64_t{1} << 32U;
    const std::int64_t low = value % kHalf;
    return Wide(static_cast<double>(value - low)) + Wide(static_cast<double>(low));
  }

  [[nodiscard]] constexpr explicit operator double() const { return value_.hi + value_.lo; }

  friend constexpr Wide operator-(Wide a) { return Wide(-a.value_); }
  friend constexpr Wide operator+(Wide a, Wide b) { return Wide(a.value_ + b.value_); }
  friend constexpr Wide operator-(Wide a, Wide b) { return Wide(a.value_ - b.value_); }
  friend constexpr Wide operator*(Wide a, Wide b) { return Wide(a.value_ * b.value_); }
  friend constexpr Wide operator*(Wide a, double b) {
    const DoubleDouble p = two_product(a.value_.hi, b);
    return Wide(quick_two_sum(p.hi, p.lo + a.value_.lo * b));
  }
  friend constexpr Wide operator*(double a, Wide b) { return b * a; }
  /// "DWDivDW2".
  friend constexpr Wide operator/(Wide a, Wide b) {
    const double quotient = a.value_.hi / b.value_.hi;
    const DoubleDouble taken = (b * quotient).value_;
    const double left = (a.value_.hi - taken.hi) + (a.value_.lo - taken.lo);
    return Wide(quick_two_sum(quotient, left / b.value_.hi));
  }
  friend constexpr bool operator<(Wide a, Wide b) {
    return a.value_.hi < b.value_.hi || (a.value_.hi == b.value_.hi && a.value_.lo < b.value_.lo);
  }
  friend constexpr bool operator>(Wide a, Wide b) { return b < a; }
  friend constexpr Wide abs(Wide a) { return a < Wide(0.0) ? -a : a; }

  constexpr Wide& operator+=(Wide b) { return *this = *this + b; }
  constexpr Wide& operator-=(Wide b) { return *this = *this - b; }
  constexpr Wide& operator*=(Wide b) { return *this = *this * b; }
  constexpr Wide& operator/=(Wide b) { return *this = *this / b; }

 private:
  constexpr explicit Wide(DoubleDouble value) : value_(value) {}

  DoubleDouble value_;
};

}  // namespace obvid::numeric
