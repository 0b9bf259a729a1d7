// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "obvid/curve/nurbs.h"

namespace obvid {

/// The B-splines that are not zero at a parameter, and their derivatives: `value[r][j]` is the r-th
/// derivative of number `first + j`, j = 0 .. degree.
struct BasisValues {
  std::size_t first = 0;
  std::array<std::array<double, kMaxNurbsDegree + 1>, 4> value{};
};

/// Number k of the span with knots[k] <= u < knots[k + 1] that has a length; outside the domain the
/// end span. Knots clamped or not, at least one span with a length.
[[nodiscard]] std::size_t span_at(int degree, const std::vector<double>& knots, double u);

/// B-splines and `derivatives` <= 3 derivatives by the recurrence of Cox and de Boor, O(degree^2).
[[nodiscard]] BasisValues basis_at(int degree, const std::vector<double>& knots, double u,
                                   int derivatives);

/// Knots without their repetitions.
[[nodiscard]] inline std::vector<double> distinct(std::vector<double> knots) {
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

}  // namespace obvid
