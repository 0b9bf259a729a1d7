// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace obvid {

/// Where a continuous function is 0 between two places at which its signs differ (`fa`, `fb`: its
/// values there), to rounding: false position that halves the value that stays (the Illinois
/// method, Dowell 1971), every fourth step a halving.
template <class F>
[[nodiscard]] double root_of(const F& f, double a, double b, double fa, double fb) {
  constexpr int kMost = 100;
  double kept = 0.0;
  for (int k = 0; k < kMost && fa != 0.0 && fb != 0.0; ++k) {
    const double middle = 0.5 * (a + b);
    if (!(std::min(a, b) < middle && middle < std::max(a, b))) break;
    double at = k % 4 == 3 ? middle : a - fa * (b - a) / (fb - fa);
    if (!(std::min(a, b) < at && at < std::max(a, b))) at = middle;
    const double f_at = f(at);
    if ((f_at < 0.0) == (fa < 0.0)) {
      a = at;
      fa = f_at;
      if (kept > 0.0) fb *= 0.5;
      kept = 1.0;
    } else {
      b = at;
      fb = f_at;
      if (kept < 0.0) fa *= 0.5;
      kept = -1.0;
    }
  }
  return fa == 0.0 ? a : fb == 0.0 ? b : std::abs(fa) < std::abs(fb) ? a : b;
}

}  // namespace obvid
