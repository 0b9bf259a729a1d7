// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/internal/collocation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

std::vector<double> not_a_knot(const std::vector<double>& t, std::size_t degree) {
  std::vector<double> knots(degree + 1, t.front());
  for (std::size_t i = 2; degree == 3 && i + 2 < t.size(); ++i) knots.push_back(t[i]);
  knots.insert(knots.end(), degree + 1, t.back());
  return knots;
}

/// B-splines at the parameters, factored.
Result<Collocation> factored(int degree, std::vector<double> knots, const std::vector<double>& at,
                             std::size_t width) {
  Collocation system{degree, std::move(knots), BandedMatrix(at.size(), width, width)};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const BasisValues basis = basis_at(degree, system.knots, at[i], 0);
    for (std::size_t j = 0; j <= static_cast<std::size_t>(degree); ++j) {
      if (basis.value[0][j] != 0.0) system.matrix.at(i, basis.first + j) = basis.value[0][j];
    }
  }
  if (system.matrix.factor()) return system;
  return error(ErrorCode::kSizeOutOfRange, "parameters are too uneven for a spline");
}

}  // namespace

std::vector<double> greville(int degree, const std::vector<double>& knots) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> at(knots.size() - p - 1);
  for (std::size_t i = 0; i < at.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 1; j <= p; ++j) sum += knots[i + j];
    // means of equal knots are that knot, whatever the sum rounds to
    at[i] = knots[i + 1] == knots[i + p] ? knots[i + 1] : sum / static_cast<double>(p);
  }
  return at;
}

double largest_spread(const std::vector<double>& parameters) {
  const auto across = cubic_collocation(parameters);
  if (!across) return 1.0;
  const std::size_t n = parameters.size();
  std::vector<double> ones(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) ones[i * n + i] = 1.0;
  across->matrix.solve_rows(ones, n);
  double most = 1.0;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += std::abs(ones[j * n + i]);
    most = std::max(most, sum);
  }
  return most;
}

Result<Collocation> greville_collocation(int degree, std::vector<double> knots) {
  const std::vector<double> at = greville(degree, knots);
  return factored(degree, std::move(knots), at, static_cast<std::size_t>(degree));
}

Result<Collocation> cubic_collocation(const std::vector<double>& parameters) {
  const std::size_t n = parameters.size();
  if (n < 2) {
    return error(ErrorCode::kTooFewPoints, "at least two parameters are needed")
        .value(static_cast<double>(n));
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (parameters[i] > parameters[i - 1]) continue;
    return error(ErrorCode::kOutOfOrder, fmt::format("parameter {} is not above the one before", i))
        .point(i)
        .value(parameters[i]);
  }
  const std::size_t degree = std::min<std::size_t>(3, n - 1);
  // the second and the last but one parameter lie inside the end spans: two diagonals on each side
  return factored(static_cast<int>(degree), not_a_knot(parameters, degree), parameters, 2);
}

}  // namespace obvid
