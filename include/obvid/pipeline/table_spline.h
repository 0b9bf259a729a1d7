// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/io/internal/read_columns.h"
#include "obvid/pipeline/spline_grid.h"
#include "obvid/pipeline/spline_job.h"
#include "obvid/surface/surface.h"

namespace obvid {

/// A table and the name that stands in reports and errors.
struct NamedTable {
  std::string name;
  ColumnTable table;
};

/// The same of a file; "-" is standard input. Errors: those of `read_columns`.
[[nodiscard]] Result<NamedTable> read_table(const std::string& path);
/// Of a text that was read.
[[nodiscard]] Result<NamedTable> parse_table(const std::string& text, const std::string& name);

/// What `obvid spline` makes of a table: of a function of one variable or points of a curve, or of
/// a function of two variables (columns x, y and f).
using TableSpline = std::variant<SplineReport, GridSplineReport>;

/// Takes the columns of `table` as the job and their names say, and those of `finer` in the same
/// way. Errors: those of `spline_input`, `grid_spline_input` and of both reports; E203 options that
/// functions of two variables do not have; E103.
[[nodiscard]] Result<TableSpline> spline_of_table(const NamedTable& table,
                                                  const std::optional<NamedTable>& finer,
                                                  const SplineJob& job, const RunContext& run = {});

/// As `obvid spline --json` prints it: docs/schema/spline.schema.json.
[[nodiscard]] std::string table_spline_json(const TableSpline& spline);

/// A file by the ending of `path`: .csv (of one variable `samples` rows; of two, as many places
/// along x and along y as give no more), .json; of one variable .svg and .dxf too. Error: E202.
[[nodiscard]] Result<std::string> table_spline_file(const TableSpline& spline,
                                                    const std::string& path, std::size_t samples);

/// Whether a file of this name has the graph of a function of two variables, in a format of
/// surfaces: any ending but those of `table_spline_file`.
[[nodiscard]] bool is_graph_file(const TableSpline& spline, const std::string& path);

/// The graph of a function of two variables as a surface, exactly; of others nothing.
[[nodiscard]] Result<std::optional<SurfaceModel>> table_spline_graph(const TableSpline& spline);

}  // namespace obvid
