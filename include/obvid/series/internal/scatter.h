// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// How far measured points scatter about a smooth curve, across it.
struct Scatter {
  double deviation = 0.0;     ///< standard deviation, units
  std::size_t places = 0;     ///< points that it was estimated from
  double bound_factor = 0.0;  ///< times the deviation: 95 times of 100 no point is farther
  double bound = 0.0;         ///< `deviation` times `bound_factor`, units
};

/// Standard deviation of the points across the curve that they were measured on, from the points
/// alone. Each point is compared with the cubic through two neighbours on each side, over their
/// chord; the median of these residuals is robust against outliers and corners (Hampel 1974). The
/// part of it that the curve itself has, as each cubic misses a derivative of fourth order, is
/// known from the same residuals with every second point, where it is 16 times as large, and is
/// taken off.
///
/// Assumes errors that are independent, normal and alike at all points, and neighbours about evenly
/// spaced; the bound holds for these with a probability of at least 0.95 (union bound with
/// P(|z| > k) <= exp(-k^2/2)). Not guaranteed for anything else. O(n log n), invariant under
/// motions and scaling but for rounding. Errors: E304 fewer than 20 points can be compared; E302
/// what is seen is the curve, not scatter: the points are smooth, or too far apart.
[[nodiscard]] Result<Scatter> scatter_of(const std::vector<Vec2>& points);

/// 1.4826 times the median of the same residuals, each for the error of one point, the part of the
/// curve with it. Nothing where fewer than 20 points can be compared.
[[nodiscard]] std::optional<double> middle_deviation(const std::vector<Vec2>& points);

}  // namespace obvid
