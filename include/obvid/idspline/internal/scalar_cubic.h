// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/idspline/internal/cell.h"

namespace obvid {

/// Cubic spline of one variable by values and slopes, the usual choice that integro-differential
/// splines are compared with ([004], formulas (12) to (17)). It interpolates; the integral over a
/// cell is what it happens to be. For curves in the plane see `CubicSpline`.
struct ScalarCubic {
  std::vector<double> nodes;  ///< ascending, at least two
  std::vector<double> values;
  std::vector<double> slopes;
};

/// Data at both ends; what is absent comes from the cubic through the four nearest nodes (all of
/// them when there are fewer), which keeps the order of approximation.
struct CubicEnds {
  std::optional<double> start;
  std::optional<double> end;
};

/// Slopes from the parabola through three neighbouring nodes (13): C1, each cell known by four
/// nodes. Errors of these three: E201, E303, E304, E309, E313 as `id_spline`.
[[nodiscard]] Result<ScalarCubic> local_cubic(std::vector<double> nodes,
                                              std::vector<double> values);

/// C2 by the equations for slopes (14); `ends` are slopes.
[[nodiscard]] Result<ScalarCubic> global_cubic_by_slopes(std::vector<double> nodes,
                                                         std::vector<double> values,
                                                         const CubicEnds& ends = {});

/// C2 by the equations for second derivatives (17); `ends` are second derivatives: {0, 0} is the
/// natural spline.
[[nodiscard]] Result<ScalarCubic> global_cubic_by_seconds(std::vector<double> nodes,
                                                          std::vector<double> values,
                                                          const CubicEnds& ends = {});

/// C2 and periodic: the last node is the first one again, one period on, and has its value.
[[nodiscard]] Result<ScalarCubic> periodic_cubic(std::vector<double> nodes,
                                                 std::vector<double> values);

/// Polynomial on cell i.
[[nodiscard]] CellPolynomial cell(const ScalarCubic& spline, std::size_t i);

/// Value and derivatives; outside the nodes the end pieces go on. O(log n).
[[nodiscard]] ScalarJet evaluate(const ScalarCubic& spline, double x);

/// Integral from a to b; O(log n + cells between).
[[nodiscard]] double integral(const ScalarCubic& spline, double a, double b);

}  // namespace obvid
