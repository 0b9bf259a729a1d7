// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/spline_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/spline_grid.h"
#include "surface_outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kErrorDigits = 3, kLengthDigits = 7;

std::string error_figure(double value) {
  return std::isnan(value) ? "-" : significant(value, kErrorDigits);
}

std::string length_figure(double value) {
  return std::isnan(value) ? "-" : significant(value, kLengthDigits);
}

std::string spline_text(const SplineReport& report) {
  const bool function = report.input.dimensions == 1;
  const std::size_t cells = report.input.nodes.size() - 1;
  std::string out = bold(report.input.name) + "\n";
  out += fmt::format("{}, {}\n",
                     function                       ? "function of x"
                     : report.input.dimensions == 2 ? "curve in the plane"
                                                    : "curve in space",
                     counted(cells, "cell", "cells"));
  if (function) {
    out += report.input.integrals.empty() ? "integrals: taken from the values\n"
                                          : "integrals: given, one per cell\n";
  }
  out += fmt::format("moves: straight, within {} of the spline\n\n",
                     significant(report.tolerance, kErrorDigits));
  Table table;
  table.column("spline", Table::Align::kLeft);
  for (const char* head :
       {"largest\nerror", "\nat", "root mean\nsquare", "largest\nmove", "\nintegral",
        "error of a\ncell", "\nmoves", "length of\nthe path", "path from\nthe truth"}) {
    table.column(head);
  }
  for (const SplineRow& row : report.rows) {
    table.row({row.name, error_figure(row.largest_error), error_figure(row.largest_at),
               error_figure(row.rms_error), error_figure(row.largest_move),
               length_figure(row.integral), error_figure(row.integral_error),
               std::to_string(row.blocks), length_figure(row.path_length),
               error_figure(row.path_deviation)});
  }
  out += table.text();
  if (std::isnan(report.rows.front().largest_error)) {
    out += "\nerrors         not known: --against FILE measures them against finer data\n";
  } else {
    out += "\n";
  }
  out += fmt::format("slope          steps by up to {} at the nodes\n",
                     report.largest_jump > 0.0 ? significant(100.0 * report.largest_jump, 2) + " %"
                                               : std::string("0"));
  return out;
}

Result<std::string> file_text(const std::string& path, const SplineReport& report,
                              std::size_t samples) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".csv") return spline_samples_csv(report, samples);
  if (ending == ".json") return spline_report_json(report) + "\n";
  if (ending == ".svg") return spline_svg(report);
  if (ending == ".dxf") return spline_dxf(report);
  return error(ErrorCode::kUnknownFormat, "spline writes no such file")
      .where(path)
      .hint("possible are .csv, .json, .svg and .dxf");
}

std::string grid_text(const GridSplineReport& report) {
  const GridSplineInput& input = report.input;
  std::string out = bold(input.name) + "\n";
  out += fmt::format("function of x and y, {} x {} cells\n", input.data.x.size() - 1,
                     input.data.y.size() - 1);
  const auto from = [](bool given) { return given ? "given" : "taken from the values"; };
  out += fmt::format("integrals over cells: {}; along lines: {}\n\n", from(input.cells_given),
                     from(input.lines_given));
  Table table;
  table.column("spline", Table::Align::kLeft);
  for (const char* head : {"largest\nerror", "at\nx", "\ny", "root mean\nsquare", "largest\nmove",
                           "\nintegral", "error of a\ncell"}) {
    table.column(head);
  }
  for (const GridSplineRow& row : report.rows) {
    table.row({row.name, error_figure(row.largest_error), error_figure(row.largest_x),
               error_figure(row.largest_y), error_figure(row.rms_error),
               error_figure(row.largest_move), length_figure(row.integral),
               error_figure(row.integral_error)});
  }
  out += table.text();
  if (std::isnan(report.rows.front().largest_error)) {
    out += "\nerrors         not known: --against FILE measures them against finer data\n";
  }
  return out;
}

/// Files of a function of two variables: its own, or its graph in those of surfaces.
Result<void> write_grid(const GridSplineReport& report, const SplineOptions& options) {
  std::vector<std::string> own, drawn;
  for (const std::string& path : options.outputs) {
    const std::string ending = std::filesystem::path(path).extension().string();
    (ending == ".csv" || ending == ".json" ? own : drawn).push_back(path);
  }
  const auto outputs = surface_outputs_of(drawn, {options.input});
  OBVID_TRY(outputs);
  const auto model = graph_of(report);
  OBVID_TRY(model);
  std::vector<std::string> warnings;
  const auto written = write_surface(*model, *outputs, {}, {}, warnings);
  OBVID_TRY(written);
  warn(warnings);
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(options.samples)));
  for (const std::string& path : own) {
    const bool csv = std::filesystem::path(path).extension() == ".csv";
    const std::string text =
        csv ? grid_spline_csv(report, std::max<std::size_t>(side, 2)) : grid_spline_json(report);
    OBVID_TRY(write_file(path, text));
  }
  return {};
}

/// The exit code for a function of two variables.
int run_grid(const ColumnTable& table, const SplineOptions& options) {
  auto input = grid_spline_input(table, options.input == "-" ? "standard input" : options.input);
  if (!input) return report(input.error());
  std::optional<GridPlaces> finer;
  if (!options.finer.empty()) {
    const auto more = read_columns(options.finer);
    if (!more) return report(more.error());
    auto places = grid_places(*more, options.finer);
    if (!places) return report(places.error());
    finer = std::move(*places);
  }
  if (options.job.options.degree != 2 ||
      options.job.options.smoothing == IdSmoothing::kValuesKept) {
    return report({ErrorCode::kBadOption, "functions of two variables have degree 2",
                   "--degree, --smooth", "--smooth none or values-free"});
  }
  const bool smooth = options.job.options.smoothing == IdSmoothing::kValuesFree;
  const auto made = grid_spline_report(std::move(*input), smooth, finer);
  if (!made) return report(made.error());
  if (auto done = write_grid(*made, options); !done) return report(done.error());
  std::string text = options.json ? grid_spline_json(*made) : grid_text(*made);
  for (const std::string& path : options.outputs) {
    if (!options.json) text += fmt::format("written        {}\n", path);
  }
  if (options.quiet && !options.json) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

Result<SplineInput> input_of(const std::string& path, bool curve) {
  const auto table = read_columns(path);
  OBVID_TRY(table);
  return spline_input(*table, path == "-" ? "standard input" : path, curve);
}

}  // namespace

int run(const SplineOptions& options) {
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const auto table = read_columns(options.input);
  if (!table) return report(table.error());
  if (!options.job.curve && is_grid_table(*table)) return run_grid(*table, options);
  const std::string name = options.input == "-" ? "standard input" : options.input;
  auto input = spline_input(*table, name, options.job.curve);
  if (!input) return report(input.error());
  std::optional<SplineInput> finer;
  if (!options.finer.empty()) {
    auto more = input_of(options.finer, options.job.curve);
    if (!more) return report(more.error());
    finer = std::move(*more);
  }
  const auto made = spline_report(std::move(*input), options.job, finer);
  if (!made) return report(made.error());
  std::vector<std::string> texts;
  for (const std::string& path : options.outputs) {
    auto text = file_text(path, *made, options.samples);
    if (!text) return report(text.error());
    texts.push_back(std::move(*text));
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (auto done = write_file(options.outputs[i], texts[i]); !done) return report(done.error());
  }
  std::string text = options.json ? spline_report_json(*made) : spline_text(*made);
  for (const std::string& path : options.outputs) {
    if (!options.json) text += fmt::format("written        {}\n", path);
  }
  if (options.quiet && !options.json) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
