// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// Place in [a, b] where f, which has one top there, is largest: golden sections until less than
/// `within` is left, or down to neighbouring doubles. A flat top is found as well as f tells its
/// values apart.
template <class Function>
[[nodiscard]] double highest_place(double a, double b, const Function& f, double within = 0.0) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kMost = 200;  // more than doubles have
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double at_c = f(c), at_d = f(d);
  for (int k = 0; k < kMost && c < d && b - a > within; ++k) {
    if (at_c >= at_d) {
      b = d, d = c, at_d = at_c;
      c = b - kGolden * (b - a), at_c = f(c);
    } else {
      a = c, c = d, at_c = at_d;
      d = a + kGolden * (b - a), at_d = f(d);
    }
  }
  return 0.5 * (a + b);
}

/// The same where f has one bottom there and is smallest.
template <class Function>
[[nodiscard]] double lowest_place(double a, double b, const Function& f, double within = 0.0) {
  return highest_place(
      a, b, [&](double x) { return -f(x); }, within);
}

}  // namespace obvid
