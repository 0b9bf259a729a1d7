// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "obvid/numeric/internal/strict_arithmetic.h"

namespace obvid {
namespace {  // see strict_arithmetic.h

/// Polynomials on [0, 1] in *scaled* Bernstein form: p = sum c_j t^j s^(n-j) with s = 1 - t, so
/// c_j is the Bernstein coefficient times binomial(n, j). Products are then plain convolutions.
/// S is any ring with S + S, S - S, S * S, S * int: double, DoubleDouble or an exact integer.
template <class S, std::size_t Count>
using ScaledBernstein = std::array<S, Count>;

[[nodiscard]] constexpr double binomial(int n, int k) {
  if (k < 0 || k > n) return 0.0;
  double value = 1.0;
  for (int j = 1; j <= k; ++j) value = value * (n - k + j) / j;  // exact: an integer at each step
  return value;
}

/// target += a * b
template <class S, std::size_t A, std::size_t B>
constexpr void add_product(std::array<S, A + B - 1>& target, const std::array<S, A>& a,
                           const std::array<S, B>& b) {
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < B; ++j) target[i + j] = target[i + j] + a[i] * b[j];
  }
}

/// target -= a * b
template <class S, std::size_t A, std::size_t B>
constexpr void subtract_product(std::array<S, A + B - 1>& target, const std::array<S, A>& a,
                                const std::array<S, B>& b) {
  for (std::size_t i = 0; i < A; ++i) {
    for (std::size_t j = 0; j < B; ++j) target[i + j] = target[i + j] - a[i] * b[j];
  }
}

/// Partial derivative of the homogeneous form by t; its degree is one lower.
template <class S, std::size_t Count>
[[nodiscard]] constexpr std::array<S, Count - 1> partial_t(const std::array<S, Count>& c,
                                                           int factor = 1) {
  std::array<S, Count - 1> result{};
  for (std::size_t j = 0; j + 1 < Count; ++j) {
    result[j] = c[j + 1] * (factor * static_cast<int>(j + 1));
  }
  return result;
}

/// Partial derivative of the homogeneous form by s = 1 - t. The derivative of p along the
/// interval is partial_t - partial_s.
template <class S, std::size_t Count>
[[nodiscard]] constexpr std::array<S, Count - 1> partial_s(const std::array<S, Count>& c,
                                                           int factor = 1) {
  std::array<S, Count - 1> result{};
  for (std::size_t j = 0; j + 1 < Count; ++j) {
    result[j] = c[j] * (factor * static_cast<int>(Count - 1 - j));
  }
  return result;
}

}  // namespace
}  // namespace obvid
