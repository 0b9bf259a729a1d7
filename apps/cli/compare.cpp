// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare.h"
#include "interrupt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "fit_report.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/internal/summary.h"
#include "outputs.h"
#include "series_of.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kComparedDigits = 4;

std::string length_text(double value) { return significant(value, kComparedDigits); }

std::string length_text(const std::optional<double>& value) {
  return value ? length_text(*value) : "-";
}

Table carrier_table(const Comparison& compared) {
  Table table;
  table.column("carrier", Table::Align::kLeft);
  table.column("pieces");
  table.column("control\npoints");
  table.column("joints");
  table.column("vertices");
  table.column("inflec-\ntions");
  table.column("error\nbound");
  table.column("from the\nspirals");
  table.column("outside their\nregion");
  table.column("time, ms");
  table.column("verdict", Table::Align::kLeft);
  for (const ComparedCarrier& row : compared.carriers) {
    if (row.refusal) {
      table.row({to_string(row.carrier), "-", "-", "-", "-", "-", "-", "-", "-", "-",
                 code_text(*row.refusal) + ", see below"});
      continue;
    }
    const Certificate& certificate = row.fit.certificate;
    table.row({to_string(row.carrier), std::to_string(row.fit.contour.pieces.size()),
               row.control_points == 0 ? "-" : std::to_string(row.control_points),
               continuity_name(row), std::to_string(certificate.vertices),
               std::to_string(certificate.inflections),
               length_text(row.fit.report.largest_deviation),
               length_text(row.fit.report.carrier_deviation),
               length_text(row.fit.report.outside_spirals_region),
               significant(row.seconds * 1e3, 3), carrier_verdict(row)});
  }
  return table;
}

/// Carriers that promise monotone runs, with more vertices than the spirals.
void add_more_vertices(const Comparison& compared, std::vector<std::string>& out) {
  const int least = compared.carriers.front().fit.certificate.vertices;
  for (const ComparedCarrier& row : compared.carriers) {
    const int more = row.refusal ? 0 : row.fit.certificate.vertices - least;
    if (more <= 0 || !promises_monotone(row.carrier)) continue;
    out.push_back(fmt::format("{} has {} more than the spirals", to_string(row.carrier),
                              counted(static_cast<std::size_t>(more), "vertex", "vertices")));
  }
}

/// Carriers that follow other spirals than those of the first row.
void add_other_spirals(const Comparison& compared, std::vector<std::string>& out) {
  const Continuity shown = compared.carriers.front().followed;
  std::vector<std::string> each;
  std::string last;
  std::size_t followers = 0;
  for (const ComparedCarrier& row : compared.carriers) {
    if (row.refusal || !follows_spirals(row.carrier)) continue;
    ++followers;
    if (row.followed == shown) continue;
    last = to_string(row.followed);
    each.push_back(fmt::format("{} follows the {} spirals, and is measured against them",
                               to_string(row.carrier), last));
  }
  if (each.size() >= 2 && each.size() == followers) {
    each = {fmt::format("the other carriers follow the {} spirals, and are measured against them",
                        last)};
  }
  out.insert(out.end(), each.begin(), each.end());
}

/// What the table means.
std::vector<std::string> comparison_legend(const Comparison& compared) {
  const bool slopes = compared.carriers.front().fit.contour.continuity == Continuity::kG3;
  return {
      "error bound: no monotone curve with this one's own tangents and curvatures at the "
      "points is farther from it",
      fmt::format("joints: G1 common tangent, G2 continuous curvature{}",
                  slopes ? ", G3 its slope too" : "")};
}

/// What is known besides: why a carrier has no figures, what follows what.
std::vector<std::string> comparison_notes(const Comparison& compared) {
  std::vector<std::string> out;
  for (const ComparedCarrier& row : compared.carriers) {
    if (!row.refusal) continue;
    const Error& e = *row.refusal;
    out.push_back(fmt::format("{}: {}: {}{}", to_string(row.carrier), code_text(e), e.what,
                              e.where.empty() ? "" : " (" + e.where + ")"));
  }
  const Contour& spirals = compared.carriers.front().fit.contour;
  if (const std::string drawn = as_drawn_text(spirals); !drawn.empty()) {
    out.push_back("every carrier keeps " + drawn);
  }
  add_more_vertices(compared, out);
  add_other_spirals(compared, out);
  return out;
}

std::string comparison_text(const PointSeries& series, const Comparison& compared) {
  const Fit& spirals = compared.carriers.front().fit;
  std::string out = series.name.empty() ? "" : bold(series.name) + "\n";
  out += fmt::format("{} points, lengths in {}, tolerance {}\n", spirals.contour.points.size(),
                     series.units.text(), length_text(spirals.report.tolerance));
  for (const std::string& line : comparison_legend(compared)) out += line + "\n";
  out += "\n" + carrier_table(compared).text();
  const std::vector<std::string> notes = comparison_notes(compared);
  if (!notes.empty()) out += "\n";
  for (const std::string& note : notes) out += note + "\n";
  return out;
}

std::string comparison_page(const PointSeries& series, const Comparison& compared,
                            const ShownCurvatures& shown, const std::string& asked) {
  ReportPage page;
  page.title = series.name;
  const auto proved = std::count_if(
      compared.carriers.begin(), compared.carriers.end(),
      [](const ComparedCarrier& row) { return !row.refusal && row.fit.certificate.proved; });
  page.verdict = fmt::format("{} of {} carriers proved", proved, compared.carriers.size());
  page.pictures.push_back(comparison_svg(series, compared, shown));
  const Fit& spirals = compared.carriers.front().fit;
  page.figures = {{"asked for", asked},
                  {"lengths in", series.units.text()},
                  {"points", std::to_string(spirals.contour.points.size())},
                  {"tolerance", length_text(spirals.report.tolerance)}};
  page.warnings = compared.carriers.front().fit.warnings;
  page.notes = comparison_legend(compared);
  const std::vector<std::string> more = comparison_notes(compared);
  page.notes.insert(page.notes.end(), more.begin(), more.end());
  page.tables.push_back(table_of_page("carriers", "Carriers", carrier_rows(compared)));
  return page_text(page);
}

Result<std::string> comparison_file_of(FileFormat format, const PointSeries& series,
                                       const Comparison& compared, const CompareOptions& options) {
  if (format != FileFormat::kPage) return comparison_file(format, series, compared, options.shown);
  return comparison_page(series, compared, options.shown, options.asked);
}

}  // namespace

int run(const CompareOptions& options) {
  if (!options.inputs.empty()) return compare_several(options);
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  std::vector<Output> outputs;
  for (const std::string& path : options.outputs) {
    const auto format = table_format_of(path, "a comparison", ".csv and .json (tables)");
    if (!format) return report(format.error());
    outputs.push_back({path, *format, {}});
  }
  ProgressBar bar(options.progress);
  Result<PointSeries> series = series_of(options);
  if (!series) {
    bar.clear();
    return report(series.error());
  }
  Comparison finished;
  const Result<Comparison> compared = [&] {
    const Interrupt interrupt;
    const RunContext context(bar.progress(), [&interrupt] { return interrupt.asked(); });
    return compare_carriers(*series, options.job, context, &finished);
  }();
  bar.clear();
  // a formed contour carries those of its series, too
  warn(compared ? compared->carriers.front().fit.warnings : series->warnings);
  if (!compared) {
    if (!finished.carriers.empty()) {
      const auto shown = put(comparison_text(*series, finished));
      if (!shown) return report(shown.error());
    }
    return report(compared.error());
  }
  for (Output& output : outputs) {
    auto text = comparison_file_of(output.format, *series, *compared, options);
    if (!text) return report(text.error());
    output.text = std::move(*text);
  }
  const auto written = write_files(outputs, options.input);
  if (!written) return report(written.error());
  std::string shown = options.json  ? comparison_json(*series, *compared)
                      : options.csv ? csv_text(carrier_rows(*compared))
                                    : comparison_text(*series, *compared);
  if (options.quiet && !options.json && !options.csv) return 0;
  if (!written->empty() && !options.json && !options.csv) {
    shown += "\nwritten  " + listed(*written) + "\n";
  }
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
