// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/table_spline.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "commands.h"
#include "obvid/core/files.h"
#include "spline_options.h"
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

std::string table_text(const TableSpline& made) {
  const auto* const curve = std::get_if<SplineReport>(&made);
  return curve != nullptr ? spline_text(*curve) : grid_text(std::get<GridSplineReport>(made));
}

Result<void> write_graph(const TableSpline& made, const std::vector<std::string>& files,
                         const SplineOptions& options) {
  if (files.empty()) return {};
  const auto outputs = surface_outputs_of(files, {options.input});
  OBVID_TRY(outputs);
  const auto model = table_spline_graph(made);
  OBVID_TRY(model);
  std::vector<std::string> warnings;
  const auto written = write_surface(**model, *outputs, {}, {}, warnings);
  OBVID_TRY(written);
  warn(warnings);
  return {};
}

Result<void> write_spline(const TableSpline& made, const SplineOptions& options) {
  std::vector<std::string> drawn;
  std::vector<Output> texts;
  for (const std::string& path : options.outputs) {
    if (is_graph_file(made, path)) {
      drawn.push_back(path);
      continue;
    }
    auto text = table_spline_file(made, path, options.samples);
    OBVID_TRY(text);
    texts.push_back({path, {}, std::move(*text)});
  }
  OBVID_TRY(write_graph(made, drawn, options));
  OBVID_TRY(write_files(texts));
  return {};
}

Result<TableSpline> made_of(const SplineOptions& options, ProgressBar& bar) {
  OBVID_TRY(check_outputs(options.outputs, {&options.input, 1}));
  for (const std::string& path : options.outputs) {  // CAD files hold graphs, which are surfaces
    const auto format = surface_format_of(path);
    if (!format) continue;
    if (auto able = can_write_surfaces(*format); !able) return fail(of_file(able.error(), path));
  }
  const auto table = read_table(options.input);
  OBVID_TRY(table);
  std::optional<NamedTable> finer;
  if (!options.finer.empty()) {
    auto more = read_table(options.finer);
    OBVID_TRY(more);
    finer = std::move(*more);
  }
  return spline_of_table(*table, finer, options.job, bar.progress());
}

}  // namespace

int run(const SplineOptions& options) {
  ProgressBar bar(options.progress);
  const auto made = made_of(options, bar);
  bar.clear();
  if (!made) return report(made.error());
  if (auto done = write_spline(*made, options); !done) return report(done.error());
  std::string text = options.json ? table_spline_json(*made) : table_text(*made);
  for (const std::string& path : options.outputs) {
    if (!options.json) text += fmt::format("written        {}\n", path);
  }
  if (options.quiet && !options.json) return 0;
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
