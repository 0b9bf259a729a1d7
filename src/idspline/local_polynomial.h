// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace obvid::idspline {

/// Most points of a local polynomial: degree 6.
inline constexpr std::size_t kMostPoints = 7;

/// Taylor coefficients.
using LocalPolynomial = std::array<double, kMostPoints>;

/// Polynomial through `count` nodes from `first` on, by powers of x - at. Newton's differences.
[[nodiscard]] LocalPolynomial local_polynomial(std::span<const double> nodes,
                                               std::span<const double> values, std::size_t first,
                                               std::size_t count, double at);

/// Derivative 1 or 2 at each node from the polynomial through degree + 1 nodes around it.
[[nodiscard]] std::vector<double> local_derivatives(std::span<const double> nodes,
                                                    std::span<const double> values, int degree,
                                                    int order);

/// Integral over each cell: mean of the integrals of the two polynomials through degree + 1 nodes
/// that reach one node further to the left and to the right; at the ends they are the same one.
/// Exact for polynomials of that degree (degree 2: the formula of third order).
[[nodiscard]] std::vector<double> local_integrals(std::span<const double> nodes,
                                                  std::span<const double> values, int degree);

}  // namespace obvid::idspline
