// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/collocation.h"

#include <fmt/format.h>

#include "obvid/surface/basis.h"

namespace obvid {
namespace {

std::vector<double> not_a_knot(const std::vector<double>& t, std::size_t degree) {
  std::vector<double> knots(degree + 1, t.front());
  for (std::size_t i = 2; degree == 3 && i + 2 < t.size(); ++i) knots.push_back(t[i]);
  knots.insert(knots.end(), degree + 1, t.back());
  return knots;
}

}  // namespace

Result<Collocation> cubic_collocation(const std::vector<double>& parameters) {
  const std::size_t n = parameters.size();
  if (n < 2) {
    return fail({ErrorCode::kTooFewPoints, "at least two parameters are needed", "", "", -1,
                 static_cast<double>(n)});
  }
  for (std::size_t i = 1; i < n; ++i) {
    if (parameters[i] > parameters[i - 1]) continue;
    return fail({ErrorCode::kSizeOutOfRange,
                 fmt::format("parameter {} is not above the one before", i), "", "",
                 static_cast<std::ptrdiff_t>(i), parameters[i]});
  }
  const std::size_t degree = std::min<std::size_t>(3, n - 1);
  Collocation system;
  system.degree = static_cast<int>(degree);
  system.knots = not_a_knot(parameters, degree);
  // the second and the last but one parameter lie inside the end spans: two diagonals on each side
  system.matrix = BandedMatrix(n, 2, 2);
  for (std::size_t i = 0; i < n; ++i) {
    const BasisValues basis = basis_at(system.degree, system.knots, parameters[i], 0);
    for (std::size_t j = 0; j <= degree; ++j) {
      if (basis.value[0][j] != 0.0) system.matrix.at(i, basis.first + j) = basis.value[0][j];
    }
  }
  if (!system.matrix.factor()) {
    return fail(
        {ErrorCode::kSizeOutOfRange, "parameters are too uneven for a spline", "", "", -1, 0.0});
  }
  return system;
}

}  // namespace obvid
