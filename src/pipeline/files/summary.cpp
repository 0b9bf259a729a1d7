// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/internal/figures.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/picture/internal/joints_claim.h"
#include "obvid/pipeline/internal/fit_figures.h"

namespace obvid {
namespace {

constexpr int kErrorDigits = 3;

SummaryCell count_cell(const char* name, std::size_t count, const char* one, const char* many) {
  return {name, counted(count, one, many), std::to_string(count)};
}

/// "3 vertices (at least 2 unless a curve winds)": the number, and what the points force.
SummaryCell with_bound(const char* name, int count, int bound, const char* one, const char* many) {
  return {name,
          fmt::format("{} ({})", counted(static_cast<std::size_t>(count), one, many),
                      short_bound_text(bound)),
          std::to_string(count)};
}

SummaryCell bound_cell(const char* name, int bound) { return {name, "", std::to_string(bound)}; }

}  // namespace

std::string code_text(ErrorCode code) { return fmt::format("E{}", static_cast<int>(code)); }

std::string code_text(const Error& error) { return code_text(error.code); }

std::string summary_csv_head(const std::vector<SummaryCell>& cells) {
  std::string out = "input";
  for (const SummaryCell& cell : cells) out += fmt::format(",{}", cell.name);
  return out + ",verdict\n";
}

std::string summary_csv(const std::string& name, const Summary& summary) {
  std::string out = csv_cell(name);
  for (const SummaryCell& cell : summary.cells) out += "," + csv_cell(cell.value);
  return out + "," + csv_cell(summary.error ? code_text(*summary.error) : summary.verdict) + "\n";
}

std::string summary_json(const std::string& input, const std::optional<std::size_t>& curve,
                         const Summary& summary) {
  JsonText json;
  json.begin_object().pair("input", input);
  if (curve) json.pair("curve", *curve);
  for (const SummaryCell& cell : summary.cells) {
    json.key(cell.name).raw(cell.value.empty() ? "null" : cell.value);
  }
  json.pair("verdict", summary.verdict);
  if (const auto& error = summary.error) {
    json.key("error").begin_object().pair("code", code_text(*error));
    json.pair("what", error->what).pair("where", error->where).end_object();
  }
  json.key("warnings").begin_array();
  for (const std::string& warning : summary.warnings) json.value(warning);
  std::string out = json.end_array().end_object().take();
  while (out.ends_with('\n')) out.pop_back();
  // lines inside an object are for the eye; none of its texts holds one
  std::replace(out.begin(), out.end(), '\n', ' ');
  return out + "\n";
}

std::vector<SummaryCell> summary_cells(const Fit& fit) {
  const FitReport& r = fit.report;
  const std::string unit = fit.contour.units.text();
  return {count_cell("points", fit.contour.points.size(), "point", "points"),
          count_cell("pieces", fit.contour.pieces.size(), "piece", "pieces"),
          with_bound("vertices", r.vertices, r.vertices_lower_bound, "vertex", "vertices"),
          bound_cell("vertices_lower_bound", r.vertices_lower_bound),
          count_cell("inflections", static_cast<std::size_t>(r.inflections), "inflection",
                     "inflections"),
          {"largest_move",
           r.largest_move > 0.0
               ? fmt::format("moves up to {} {}", significant(r.largest_move, kErrorDigits), unit)
               : "",
           csv_cell(r.largest_move)},
          {"largest_error", "error " + known_length(r.largest_deviation, unit, kErrorDigits),
           csv_cell(r.largest_deviation)}};
}

std::vector<SummaryCell> summary_cells(const PointSeries& series, const Analysis& a) {
  return {count_cell("points", series.points.size(), "point", "points"),
          {"size", fmt::format("size {} {}", significant(a.size), series.units.text()),
           csv_cell(a.size)},
          count_cell("runs", a.runs.size(), "run", "runs"),
          with_bound("vertices", a.vertices, a.vertices_lower_bound, "vertex", "vertices"),
          bound_cell("vertices_lower_bound", a.vertices_lower_bound),
          with_bound("inflections", a.inflections, a.inflections_lower_bound, "inflection",
                     "inflections"),
          bound_cell("inflections_lower_bound", a.inflections_lower_bound)};
}

std::vector<SummaryCell> summary_cells(const AnalysedDrawing& drawing) {
  double length = 0.0;
  for (const CurveAudit& one : drawing.audits) length += one.length;
  for (const PointSeries& one : drawing.drawing.series) length += figures_of(one).length;
  return {
      count_cell("curves", drawing.audits.size(), "curve", "curves"),
      count_cell("series", drawing.drawing.series.size(), "series of points", "series of points"),
      {"length", fmt::format("length {} {}", significant(length), drawing.drawing.units.text()),
       csv_cell(length)}};
}

std::vector<SummaryCell> summary_cells(const Contour& contour, const Certificate& certificate) {
  return {
      count_cell("pieces", contour.pieces.size(), "piece", "pieces"),
      count_cell("vertices", static_cast<std::size_t>(certificate.vertices), "vertex", "vertices"),
      count_cell("inflections", static_cast<std::size_t>(certificate.inflections), "inflection",
                 "inflections")};
}

std::vector<SummaryCell> summary_cells(const AlignmentReport& made) {
  const Alignment& alignment = made.alignment;
  std::size_t lines = 0, arcs = 0;
  for (const AlignmentElement& element : alignment.elements) {
    lines += element.kind == AlignmentKind::kLine ? 1 : 0;
    arcs += element.kind == AlignmentKind::kArc ? 1 : 0;
  }
  double largest = 0.0;
  for (const AlignmentDeviation& deviation : alignment.deviations) {
    largest = std::max(largest, std::abs(deviation.offset));
  }
  const std::string unit = made.units.text();
  return {count_cell("points", alignment.deviations.size(), "point", "points"),
          count_cell("elements", alignment.elements.size(), "element", "elements"),
          count_cell("lines", lines, "line", "lines"),
          count_cell("arcs", arcs, "arc", "arcs"),
          count_cell("transitions", alignment.elements.size() - lines - arcs, "transition",
                     "transitions"),
          {"length", fmt::format("length {} {}", significant(alignment.length), unit),
           csv_cell(alignment.length)},
          {"largest_deviation",
           fmt::format("at most {} {} off", significant(largest, kErrorDigits), unit),
           csv_cell(largest)},
          {"tolerance", "", csv_cell(made.tolerance)}};
}

std::vector<SummaryCell> summary_cells(const PointSeries& series, const RegionTable& region) {
  const WidestRow widest = widest_row(region.last());
  const std::string unit = series.units.text();
  return {count_cell("points", series.points.size(), "point", "points"),
          count_cell("segments", region.last().rows.size(), "segment", "segments"),
          {"widest",
           widest.width ? fmt::format("at most {} {} wide",
                                      significant_above(*widest.width, kErrorDigits), unit)
                        : "",
           widest.width ? csv_cell(*widest.width) : ""},
          {"unknown_segments",
           widest.unknown > 0 ? fmt::format("width unknown over {}", widest.unknown) : "",
           std::to_string(widest.unknown)}};
}

}  // namespace obvid
