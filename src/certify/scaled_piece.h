// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>

#include "curvature_form.h"
#include "decide.h"
#include "obvid/curve/pieces.h"

namespace obvid {
namespace {  // see strict_arithmetic.h

/// Calls f.template operator()<N>() for the degree of the piece, 2 to 7.
template <class F>
[[nodiscard]] PieceFacts with_degree(int degree, F&& f) {
  switch (degree) {
    case 2:
      return f.template operator()<2>();
    case 3:
      return f.template operator()<3>();
    case 4:
      return f.template operator()<4>();
    case 5:
      return f.template operator()<5>();
    case 6:
      return f.template operator()<6>();
    case 7:
      return f.template operator()<7>();
    default:
      return {};
  }
}

/// Sizes from which no product of the proof overflows, and differences stay exact enough.
inline constexpr double kSmallestSize = 0x1p-900;
inline constexpr double kLargestSize = 0x1p900;

/// Power of two that brings `size` near 1; nothing for sizes beyond what can be scaled.
[[nodiscard]] inline std::optional<double> unit_scale(double size) {
  if (!(size > kSmallestSize && size < kLargestSize)) return std::nullopt;
  constexpr int kExponentAt = 52;
  constexpr std::uint64_t kTwiceBias = 2046;
  const std::uint64_t biased = std::bit_cast<std::uint64_t>(size) >> kExponentAt;
  return std::bit_cast<double>((kTwiceBias - biased) << kExponentAt);
}

/// A copy of the piece with size and weights near 1 (scaled by powers of two: no rounding).
[[nodiscard]] inline std::optional<RationalBezier> scaled(const RationalBezier& piece) {
  const auto n = static_cast<std::size_t>(piece.degree);
  double size = 0.0;
  double weight = 0.0;
  double sum = 0.0;  // NaN or infinite where any number is
  for (std::size_t j = 0; j <= n; ++j) {
    const Vec2 q = piece.offset[j] - piece.offset[0];
    size = std::max(size, std::max(std::abs(q.x), std::abs(q.y)));
    weight = std::max(weight, std::abs(piece.weight[j]));
    sum += std::abs(q.x) + std::abs(q.y) + std::abs(piece.weight[j]);
  }
  const auto by_size = unit_scale(size);
  const auto by_weight = unit_scale(weight);
  if (!is_finite(sum) || !by_size || !by_weight) return std::nullopt;
  RationalBezier result = piece;
  for (std::size_t j = 0; j <= n; ++j) {
    result.offset[j] = *by_size * piece.offset[j];
    result.weight[j] = *by_weight * piece.weight[j];
  }
  return result;
}

/// One rounding per difference.
template <int N>
[[nodiscard]] ControlDifferences<N, double> differences_in_doubles(const RationalBezier& piece) {
  ControlDifferences<N, double> p;
  for (std::size_t k = 0; k <= N; ++k) {
    p.weight[k] = piece.weight[k];
    for (std::size_t l = k + 1; l <= N; ++l) {
      p.x[k][l] = piece.offset[l].x - piece.offset[k].x;
      p.y[k][l] = piece.offset[l].y - piece.offset[k].y;
    }
  }
  return p;
}

inline constexpr double kLattice = 1 << 20;  // resolution of test directions; any would do

[[nodiscard]] inline LatticeDirection on_lattice(Vec2 v) {
  const double size = std::max(std::abs(v.x), std::abs(v.y));
  if (!(size > 0.0)) return {};
  const double scale = kLattice / size;
  return {static_cast<int>(v.x * scale), static_cast<int>(v.y * scale)};
}

[[nodiscard]] inline Vec2 unit_or_zero(Vec2 v) {
  const double size = norm(v);
  return size > 0.0 ? v / size : Vec2{};
}

[[nodiscard]] inline Vec2 leg(const RationalBezier& piece, std::size_t k, std::size_t l) {
  return piece.offset[l] - piece.offset[k];
}

[[nodiscard]] inline LatticeDirection chord_direction(const RationalBezier& piece) {
  return on_lattice(leg(piece, 0, static_cast<std::size_t>(piece.degree)));
}

[[nodiscard]] inline TestDirections test_directions(const RationalBezier& piece) {
  const auto n = static_cast<std::size_t>(piece.degree);
  return {chord_direction(piece),
          on_lattice(unit_or_zero(leg(piece, 0, 1)) + unit_or_zero(leg(piece, n - 1, n)))};
}

}  // namespace
}  // namespace obvid
