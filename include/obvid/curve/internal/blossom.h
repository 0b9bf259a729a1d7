// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace obvid {

/// De Boor's recurrence with one argument per step ([Ramshaw 1987]): the blossom of the polynomial
/// of span k, [knots[k], knots[k + 1]], at `first` times `at_first` and otherwise at `at_others`.
/// `d` holds what belongs to the control points k - degree .. k; `mix(a, b, share)` is
/// (1 - share) a + share b, of numbers, points or weights alike. Bezier point number j of [a, b]
/// inside the span is the blossom at j times b and otherwise a.
template <class Value, std::size_t kSize, class Mix>
[[nodiscard]] Value blossom(const std::vector<double>& knots, std::size_t k, std::size_t degree,
                            std::array<Value, kSize> d, std::size_t first, double at_first,
                            double at_others, const Mix& mix) {
  for (std::size_t r = 1; r <= degree; ++r) {
    const double at = r <= first ? at_first : at_others;
    for (std::size_t i = degree; i >= r; --i) {
      const double from = knots[k - degree + i], to = knots[k + 1 + i - r];
      d[i] = mix(d[i - 1], d[i], (at - from) / (to - from));
    }
  }
  return d[degree];
}

/// Weights of the control points k - degree .. k in that blossom; degree < kSize.
template <std::size_t kSize>
[[nodiscard]] std::array<double, kSize> blossom_weights(const std::vector<double>& knots,
                                                        std::size_t k, std::size_t degree,
                                                        std::size_t first, double at_first,
                                                        double at_others) {
  using Weights = std::array<double, kSize>;
  std::array<Weights, kSize> d{};
  for (std::size_t i = 0; i <= degree; ++i) d[i][i] = 1.0;
  return blossom(knots, k, degree, d, first, at_first, at_others,
                 [degree](const Weights& a, const Weights& b, double share) {
                   Weights out{};
                   for (std::size_t m = 0; m <= degree; ++m) {
                     out[m] = (1.0 - share) * a[m] + share * b[m];
                   }
                   return out;
                 });
}

}  // namespace obvid
