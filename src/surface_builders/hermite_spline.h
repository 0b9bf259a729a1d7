// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "obvid/geom/vec3.h"

namespace obvid {

/// Value and two derivatives by a parameter.
template <class V>
struct HermiteOf {
  V point{};
  V d1{};
  V d2{};
};
using Hermite = HermiteOf<Vec3>;

/// Control points of the Bezier piece of degree 5 over a span of this length with these ends.
template <class V>
[[nodiscard]] std::array<V, 6> quintic(const HermiteOf<V>& from, const HermiteOf<V>& to,
                                       double length) {
  const double h = length / 5.0, q = length * length / 20.0;
  return {from.point,
          from.point + h * from.d1,
          from.point + 2.0 * h * from.d1 + q * from.d2,
          to.point - 2.0 * h * to.d1 + q * to.d2,
          to.point - h * to.d1,
          to.point};
}

/// Value and two derivatives of the piece at a share of its span.
template <class V>
[[nodiscard]] HermiteOf<V> evaluate(const std::array<V, 6>& piece, double part, double length) {
  std::array<V, 6> b = piece;
  HermiteOf<V> result;
  for (std::size_t n = 5; n > 0; --n) {
    if (n == 2) result.d2 = (20.0 / (length * length)) * (b[2] - 2.0 * b[1] + b[0]);
    if (n == 1) result.d1 = (5.0 / length) * (b[1] - b[0]);
    for (std::size_t j = 0; j < n; ++j) b[j] = (1.0 - part) * b[j] + part * b[j + 1];
  }
  result.point = b[0];
  return result;
}

inline constexpr int kSkinDegree = 5;

/// Knots of the C2 spline of degree 5 with these breaks: inner ones three times.
[[nodiscard]] std::vector<double> quintic_knots(const std::vector<double>& breaks);
/// Its control points: 3 for each break and span, 6 for the first.
[[nodiscard]] std::vector<Vec3> quintic_points(const std::vector<double>& breaks,
                                               const std::vector<Hermite>& data);

}  // namespace obvid
