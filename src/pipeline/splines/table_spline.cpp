// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/table_spline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/pipeline/file_formats.h"

namespace obvid {
namespace {

Result<TableSpline> of_two_variables(const NamedTable& table,
                                     const std::optional<NamedTable>& finer, const SplineJob& job,
                                     const RunContext& run) {
  auto input = grid_spline_input(table.table, table.name);
  OBVID_TRY(input);
  std::optional<GridPlaces> more;
  if (finer) {
    auto places = grid_places(finer->table, finer->name);
    OBVID_TRY(places);
    more = std::move(*places);
  }
  if (job.options.degree != 2 || job.options.smoothing == IdSmoothing::kValuesKept) {
    return error(ErrorCode::kBadOption, "functions of two variables have degree 2")
        .where("--degree, --smooth")
        .hint("--smooth none or values-free");
  }
  const bool smooth = job.options.smoothing == IdSmoothing::kValuesFree;
  auto made = grid_spline_report(std::move(*input), smooth, more, run);
  OBVID_TRY(made);
  return TableSpline(std::move(*made));
}

Result<std::string> grid_file(const GridSplineReport& report, const std::string& path,
                              std::size_t samples) {
  const auto format = graph_format_of(path);
  if (format == FileFormat::kContour) return grid_spline_json(report);
  if (format == FileFormat::kSamples) {
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(samples)));
    return grid_spline_csv(report, std::max<std::size_t>(side, 2));
  }
  return error(ErrorCode::kUnknownFormat, "functions of two variables have no such file")
      .where(path)
      .hint("possible are .csv, .json, and for the graph the formats of surfaces");
}

Result<std::string> curve_file(const SplineReport& report, const std::string& path,
                               std::size_t samples) {
  const auto format = spline_format_of(path);
  if (format == FileFormat::kSamples) return spline_samples_csv(report, samples);
  if (format == FileFormat::kContour) return spline_report_json(report);
  if (format == FileFormat::kPicture) return spline_svg(report);
  if (format == FileFormat::kDxf) return spline_dxf(report);
  return error(ErrorCode::kUnknownFormat, "spline writes no such file")
      .where(path)
      .hint("possible are .csv, .json, .svg and .dxf");
}

}  // namespace

Result<NamedTable> read_table(const std::string& path) {
  auto table = read_columns(path);
  OBVID_TRY(table);
  return NamedTable{path == "-" ? "standard input" : path, std::move(*table)};
}

Result<NamedTable> parse_table(const std::string& text, const std::string& name) {
  auto table = parse_columns(text, name);
  OBVID_TRY(table);
  return NamedTable{name, std::move(*table)};
}

Result<TableSpline> spline_of_table(const NamedTable& table, const std::optional<NamedTable>& finer,
                                    const SplineJob& job, const RunContext& run) {
  if (!job.curve && is_grid_table(table.table)) return of_two_variables(table, finer, job, run);
  auto input = spline_input(table.table, table.name, job.curve);
  OBVID_TRY(input);
  std::optional<SplineInput> more;
  if (finer) {
    auto places = spline_input(finer->table, finer->name, job.curve);
    OBVID_TRY(places);
    more = std::move(*places);
  }
  auto made = spline_report(std::move(*input), job, more, run);
  OBVID_TRY(made);
  return TableSpline(std::move(*made));
}

std::string table_spline_json(const TableSpline& spline) {
  const auto* const curve = std::get_if<SplineReport>(&spline);
  return curve != nullptr ? spline_report_json(*curve)
                          : grid_spline_json(std::get<GridSplineReport>(spline));
}

Result<std::string> table_spline_file(const TableSpline& spline, const std::string& path,
                                      std::size_t samples) {
  const auto* const curve = std::get_if<SplineReport>(&spline);
  return curve != nullptr ? curve_file(*curve, path, samples)
                          : grid_file(std::get<GridSplineReport>(spline), path, samples);
}

bool is_graph_file(const TableSpline& spline, const std::string& path) {
  return std::holds_alternative<GridSplineReport>(spline) && !graph_format_of(path);
}

Result<std::optional<SurfaceModel>> table_spline_graph(const TableSpline& spline) {
  const auto* const grid = std::get_if<GridSplineReport>(&spline);
  if (grid == nullptr) return std::optional<SurfaceModel>();
  auto model = graph_of(*grid);
  OBVID_TRY(model);
  return std::optional(std::move(*model));
}

}  // namespace obvid
