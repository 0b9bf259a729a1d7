// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace obvid {

/// Gauss-Legendre quadrature on [-1, 1] with N points, exact up to degree 2 N - 1: its positive
/// nodes, ascending, with their weights; the same again at the negative ones.
/// [Abramowitz, Stegun 1964], table 25.4. (The certifier has a table of its own: a proof shares
/// nothing with what builds.)
template <std::size_t N>
struct GaussRule;

template <>
struct GaussRule<4> {
  static constexpr std::array<double, 2> kNode = {0.33998104358485626, 0.86113631159405258};
  static constexpr std::array<double, 2> kWeight = {0.65214515486254614, 0.34785484513745386};
};

template <>
struct GaussRule<8> {
  static constexpr std::array<double, 4> kNode = {0.1834346424956498, 0.5255324099163290,
                                                  0.7966664774136267, 0.9602898564975363};
  static constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873,
                                                    0.2223810344533745, 0.1012285362903763};
};

/// Integral of f over [from, to] by N points.
template <std::size_t N, class F>
[[nodiscard]] double gauss_integral(double from, double to, const F& f) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < N / 2; ++i) {
    const double step = half * GaussRule<N>::kNode[i];
    sum += GaussRule<N>::kWeight[i] * (f(middle - step) + f(middle + step));
  }
  return half * sum;
}

}  // namespace obvid
