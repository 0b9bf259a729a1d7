// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/idspline/internal/id_spline.h"

namespace obvid {

/// Integro-differential spline of two variables on a rectangular grid: on each cell the biquadratic
/// polynomial with the given values at four corners, integrals along four edges and integral over
/// the cell. Tensor product of parabolic splines. All arrays run along x first.
struct IdSpline2d {
  std::vector<double> x, y;     ///< nodes, ascending, at least two each
  std::vector<double> values;   ///< at (x_i, y_j): entry j nx + i
  std::vector<double> along_x;  ///< over x cell i on the line y_j: entry j (nx - 1) + i
  std::vector<double> along_y;  ///< over y cell j on the line x_i: entry j nx + i
  std::vector<double> cells;    ///< over cell i, j: entry j (nx - 1) + i
};

/// What is known. Either all three kinds of integrals are given, or none: then they are taken from
/// values by the formula of third order in both directions.
using IdSpline2dData = IdSpline2d;

/// Forms the spline. Not smooth: all data kept, continuous. Smooth: C1; the integrals over cells
/// and the values at the four corners of the grid are kept, the other values and line integrals
/// give way. The integral over every cell is met to rounding either way. O(nx ny).
/// Errors: E201 numbers of data that do not belong together; E303, E304, E309, E402 as `id_spline`.
[[nodiscard]] Result<IdSpline2d> id_spline_2d(IdSpline2dData data, bool smooth = false);

/// Value and partial derivatives.
struct GridJet {
  double value = 0.0, dx = 0.0, dy = 0.0, dxx = 0.0, dxy = 0.0, dyy = 0.0;
};

/// Value and partial derivatives; outside the grid the border cells go on. O(log nx + log ny).
[[nodiscard]] GridJet evaluate(const IdSpline2d& spline, double x, double y);

/// Integral over [x0, x1] x [y0, y1]. Whole cells count with their given integrals exactly.
[[nodiscard]] double integral(const IdSpline2d& spline, double x0, double x1, double y0, double y1);

/// The spline over x at a fixed y, and over y at a fixed x: exact sections. For a raster take one
/// section per line and `evaluate_sorted`.
[[nodiscard]] IdSpline section_along_x(const IdSpline2d& spline, double y);
[[nodiscard]] IdSpline section_along_y(const IdSpline2d& spline, double x);

/// Bezier ordinates of cell i, j as biquadratic patch: [row along y][column along x].
[[nodiscard]] std::array<std::array<double, 3>, 3> bezier_ordinates(const IdSpline2d& spline,
                                                                    std::size_t i, std::size_t j);

}  // namespace obvid
