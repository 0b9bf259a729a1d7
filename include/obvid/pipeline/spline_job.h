// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/idspline/internal/id_spline.h"
#include "obvid/io/internal/read_columns.h"

namespace obvid {

/// What a spline is formed of: a function of x, or a curve in the plane or in space over the summed
/// length of its chords ([004], formula (22)).
struct SplineInput {
  std::string name;
  std::size_t dimensions = 1;               ///< of the values: 1 a function; 2, 3 a curve
  std::vector<double> nodes;                ///< x, or the summed chords, ascending
  std::vector<std::vector<double>> values;  ///< one list per dimension
  std::vector<double> integrals;            ///< of a function, one per cell; empty: not given
  std::vector<double> slopes, seconds;      ///< of a function; empty: not given
};

/// How the table is read, and what is made of it.
struct SplineJob {
  bool curve = false;  ///< columns x, y[, z] are points
  IdSplineOptions options{2, IdSmoothing::kNone};
  bool compare = false;               ///< with the other degrees and with cubic splines
  std::optional<double> tolerance{};  ///< of machining, units; nothing: 1e-4 of the size
};

/// How far a spline is from the truth, and what it costs on a machine. Lengths in units.
struct SplineRow {
  std::string name;             ///< "degree 2", "cubic, local", ...
  double largest_error = 0.0;   ///< against the finer data; NaN without them
  double largest_at = 0.0;      ///< node of the finer data where that is
  double rms_error = 0.0;       ///< root mean square over the finer data; NaN without them
  double largest_move = 0.0;    ///< of a given value
  double integral = 0.0;        ///< of a function over all cells; NaN of curves
  double integral_error = 0.0;  ///< largest of a cell, against the given integrals; NaN without
  std::size_t blocks = 0;       ///< straight moves within the tolerance of machining
  double path_length = 0.0;     ///< of these moves
  double path_deviation = 0.0;  ///< largest distance of the finer data from the path as it is
                                ///< programmed; NaN without them
};

/// A spline with its figures, and those of others beside it.
struct SplineReport {
  SplineInput input;
  std::vector<IdSpline> parts;  ///< one per dimension
  std::vector<SplineRow> rows;  ///< the chosen one first
  double tolerance = 0.0;       ///< of machining
  double largest_jump = 0.0;    ///< of the first derivative at a node, of the largest slope there
};

/// Takes the columns of a table. A function: `x` and `f` (or `y`, `value`; without a header the
/// first two), `integral` over the cell that a row begins (the last row has none), `slope`,
/// `second`. A curve: `x`, `y` and `z` if there is one. Errors: E304, E305; E201 columns that are
/// missing.
[[nodiscard]] Result<SplineInput> spline_input(const ColumnTable& table, const std::string& name,
                                               bool curve);

/// Forms the spline. `finer`: more places of the same function, or points of the same curve in the
/// same order.
/// Errors: those of `id_spline`; E103, asked for each cell and each place of `finer`.
[[nodiscard]] Result<SplineReport> spline_report(SplineInput input, const SplineJob& job,
                                                 const std::optional<SplineInput>& finer,
                                                 const RunContext& run = {});

/// Values at `count` equal steps over the nodes: x or the parameter, then per dimension the value
/// and its first and second derivative, then of a function the integral from the first node.
[[nodiscard]] std::string spline_samples_csv(const SplineReport& report, std::size_t count);

/// Everything as one JSON object: rows, and per dimension and cell the coefficients by powers of
/// x - x_i.
[[nodiscard]] std::string spline_report_json(const SplineReport& report);

/// Drawing of the spline and its points, as SVG or DXF; of a curve in space its view along z.
[[nodiscard]] std::string spline_svg(const SplineReport& report);
[[nodiscard]] std::string spline_dxf(const SplineReport& report);

}  // namespace obvid
