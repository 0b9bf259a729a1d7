// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/idspline/internal/id_spline_2d.h"
#include "obvid/io/internal/read_columns.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A function of two variables on a rectangular grid.
struct GridSplineInput {
  std::string name;
  IdSpline2dData data;  ///< integrals empty where the table has none
  bool lines_given = false;
  bool cells_given = false;
};

/// Whether a table is one of a function of two variables: columns x, y and f.
[[nodiscard]] bool is_grid_table(const ColumnTable& table);

/// Columns x, y, f, every place of the grid once, in any order; `integral`: over the cell that a
/// place begins (in both directions); `integral_x`, `integral_y`: from it to the next place along
/// x or y, both or none. What stands at places that begin no cell is not used. Lines without
/// integrals take theirs from values, cells too. Errors: E201, E304, E305, E307 gaps in the grid.
[[nodiscard]] Result<GridSplineInput> grid_spline_input(const ColumnTable& table,
                                                        const std::string& name);

/// Places of the same function that errors are measured against.
struct GridPlaces {
  std::vector<double> x, y, f;
};
/// Columns x, y, f of a table. Errors: E201, E305.
[[nodiscard]] Result<GridPlaces> grid_places(const ColumnTable& table, const std::string& name);

/// How far a spline is from what is known. NaN: not known.
struct GridSplineRow {
  std::string name;  ///< "values kept", "C1, values free"
  double largest_error = 0.0, largest_x = 0.0, largest_y = 0.0;  ///< against the finer places
  double rms_error = 0.0;
  double largest_move = 0.0;    ///< of a given value
  double integral = 0.0;        ///< over all cells
  double integral_error = 0.0;  ///< largest of a cell, against the given integrals
};

struct GridSplineReport {
  GridSplineInput input;
  IdSpline2d spline;                ///< the chosen one
  std::vector<GridSplineRow> rows;  ///< the chosen one first, then the other
};

/// Forms the spline (`smooth`: C1, values give way), and the other choice beside it. Errors: those
/// of `id_spline_2d`; E103, asked between splines and every thousand places of `finer`.
[[nodiscard]] Result<GridSplineReport> grid_spline_report(GridSplineInput input, bool smooth,
                                                          const std::optional<GridPlaces>& finer,
                                                          const RunContext& run = {});

/// The graph z = f(x, y) as a surface, exactly.
[[nodiscard]] Result<SurfaceModel> graph_of(const GridSplineReport& report);

/// x, y, f, f_x, f_y at `count` by `count` places.
[[nodiscard]] std::string grid_spline_csv(const GridSplineReport& report, std::size_t count);
/// Nodes, values, all integrals and the rows.
[[nodiscard]] std::string grid_spline_json(const GridSplineReport& report);

}  // namespace obvid
