// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/numeric/internal/banded.h"

namespace obvid {

/// What interpolation by splines at given parameters needs: the knots and the factored matrix
/// of B-splines at the parameters.
struct Collocation {
  int degree = 0;
  std::vector<double> knots;
  BandedMatrix matrix{0, 0, 0};
};

/// C2 cubic whose third derivative is continuous at the second and the last but one parameter (not
/// a knot); of 3 parameters a parabola, of 2 a line. Errors: E304 fewer than 2, E313 not ascending
/// (`index`: the later one).
[[nodiscard]] Result<Collocation> cubic_collocation(const std::vector<double>& parameters);

/// How much larger than the distances of curves from what they stand for those of a C2 cubic
/// surface through them may be: the largest sum of absolute coefficients of the cubics that are 1
/// at one parameter, 0 at the others. 1 where there is no such cubic. Time O(n^2).
[[nodiscard]] double largest_spread(const std::vector<double>& parameters);

/// Interpolation at the Greville abscissae (means of `degree` neighbouring inner knots) of any
/// clamped knots: as continuous as the knots say. Error: E309 knots too uneven for a matrix.
[[nodiscard]] Result<Collocation> greville_collocation(int degree, std::vector<double> knots);
[[nodiscard]] std::vector<double> greville(int degree, const std::vector<double>& knots);

}  // namespace obvid
