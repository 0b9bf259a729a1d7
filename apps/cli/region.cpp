// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/region_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/internal/summary.h"
#include "outputs.h"
#include "series_of.h"
#include "several.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

constexpr int kHeightDigits = 5, kWidthDigits = 4;
/// More steps of a construction are left to files.
constexpr std::ptrdiff_t kMostSteps = 60;
/// Headings are told to a hundred-thousandth of a degree: their ranges are known to some 1e-6.
constexpr double kHeadingStep = 1e-5;
constexpr int kHeadingDigits = 8;

std::string degrees_text(double degrees) {
  const double rounded = std::round(degrees / kHeadingStep) * kHeadingStep;
  return significant(rounded == 0.0 ? 0.0 : rounded, kHeadingDigits);
}

/// Least and greatest radius of a range of signed curvatures, each with its sign.
struct RadiusRange {
  std::string least;
  std::string greatest;
};

RadiusRange radius_range(const std::optional<CurvatureRange>& kappa) {
  if (!kappa) return {"-", "-"};
  const auto [least, greatest] = extreme_radii(*kappa);
  return {std::isinf(least) ? "0" : radius_text(least), radius_text(greatest)};
}

std::string measured(const std::optional<double>& length, int digits = kWidthDigits) {
  return length ? significant(*length, digits) : "-";
}

/// An end that the points leave open is marked.
std::array<std::string, 2> heading_range(const RegionPoint& p) {
  if (!p.headings) return {"-", "-"};
  const HeadingDegrees degrees(p.theta);
  const auto text = [&](double theta, bool open) {
    return degrees_text(degrees(theta)) + (open ? "*" : "");
  };
  return {text(p.headings->low, p.headings->low_is_open),
          text(p.headings->high, p.headings->high_is_open)};
}

std::vector<double> widths(const RegionPart& part) {
  std::vector<double> out;
  for (const RegionRow& row : part.rows) out.push_back(row.width.value_or(0.0));
  return out;
}

/// Names of inserted points hold a dot that is no decimal point.
Table::Align name_align(const RegionPart& part) {
  const bool inserted = std::any_of(part.points.begin(), part.points.end(),
                                    [](const RegionPoint& p) { return p.inserted > 0; });
  return inserted ? Table::Align::kLeft : Table::Align::kDecimal;
}

Table region_points(const RegionPart& part, double size) {
  Table table;
  table.column("point", name_align(part));
  for (const char* head : {"x", "y", "adjacent\nradius", "heading\ndegrees", "range of\nheadings",
                           "\nto", "least\nradius", "greatest\nradius"}) {
    table.column(head);
  }
  table.column("heading\nis", Table::Align::kLeft);
  std::vector<double> value(part.points.size(), 0.0);
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    value[part.rows[i].from] = part.rows[i].width.value_or(0.0);
  }
  add_rows_worth_showing(value, table, [&](std::size_t i) {
    const RegionPoint& p = part.points[i];
    const bool first_again = i > 0 && i + 1 == part.points.size() && p.inserted == 0 &&
                             p.number == part.points.front().number;
    if (first_again) return;
    const RadiusRange radius = radius_range(p.curvatures);
    const auto headings = heading_range(p);
    table.row({region_point_name(p), coordinate(p.point.x, size), coordinate(p.point.y, size),
               p.adjacent_kappa ? radius_text(*p.adjacent_kappa) : "-",
               degrees_text(principal_degrees(p.theta)), headings[0], headings[1], radius.least,
               radius.greatest, heading_came_by(p)});
  });
  return table;
}

Table region_segments(const RegionPart& part) {
  Table table;
  table.column("points", name_align(part));
  for (const char* head : {"chord", "points-only\nerror", "|i,T|", "|T,i+1|", "height\nh",
                           "width\ndelta", "\nH", "\nHt", "\nDelta", "\nDelta t", "\nf"}) {
    table.column(head);
  }
  add_rows_worth_showing(widths(part), table, [&](std::size_t i) {
    const RegionRow& row = part.rows[i];
    table.row({region_segment_name(part, row), significant(row.chord),
               measured(row.points_only_error), significant(row.to_apex),
               significant(row.from_apex), measured(row.lower_height, kHeightDigits),
               measured(row.width), measured(row.apex_height, kHeightDigits),
               measured(row.tangent_height, kHeightDigits), measured(row.apex_gap, kHeightDigits),
               measured(row.tangent_gap, kHeightDigits), measured(row.spline_distance)});
  });
  return table;
}

std::string region_part_text(const PointSeries& series, const RegionPart& part) {
  const double size = bounding_diagonal(series.points);
  std::string out = region_points(part, size).text() + "\n" + region_segments(part).text();
  out +=
      shown_note(rows_worth_showing(widths(part)).size(), part.rows.size(), "widest", "segments");
  Facts facts;
  for (auto& [label, value] : region_figures(part, series.units)) {
    facts.add(std::move(label), std::move(value));
  }
  return out + "\n" + facts.text();
}

std::string construction_text(const RegionTable& region) {
  const ConstructionTable& made = *region.construction;
  Table table;
  table.column("points", name_align(region.last()));
  for (const std::string& column : made.columns) table.column(column);
  table.column("", Table::Align::kLeft);
  const auto details = std::count_if(made.rows.begin(), made.rows.end(),
                                     [](const ConstructionRow& row) { return row.detail; });
  const bool all = details <= kMostSteps;
  for (const ConstructionRow& row : made.rows) {
    if (row.detail && !all) continue;
    std::vector<std::string> cells{
        region_segment_name(region.last(), region.last().rows[row.segment])};
    for (const double value : row.values) {
      cells.push_back(std::isnan(value) ? "-" : significant(value, kHeightDigits));
    }
    cells.push_back(row.remark);
    table.row(cells);
  }
  std::string out = "\n" + table.text();
  if (!all) out += fmt::format("{} rows of steps: in -o NAME.csv, .tex and --json\n", details);
  for (const std::string& remark : made.remarks) out += remark + "\n";
  return out;
}

std::string region_text(const PointSeries& series, const RegionTable& region) {
  std::string out = series.name.empty() ? "" : bold(series.name) + "\n";
  out += fmt::format("lengths in {}; radius positive where the contour turns left\n",
                     series.units.text());
  for (const std::string& line : region_legend(region)) out += line + "\n";
  out += "\n";
  out += region_part_text(series, region.user);
  if (region.refined) {
    const std::size_t more = region.refined->points.size() - region.user.points.size();
    out += fmt::format("\nwith {} inserted\n\n", counted(more, "point", "points")) +
           region_part_text(series, *region.refined);
  }
  if (region.construction) out += construction_text(region);
  return out;
}

struct NamedFile {
  std::string path;
  RegionFile file;
};

/// The files of a worksheet, written.
Result<std::vector<NamedFile>> write_worksheet(const PointSeries& series, const RegionTable& region,
                                               const RegionOptions& options) {
  std::vector<NamedFile> files;
  std::vector<Output> outputs;
  for (const std::string& path : options.outputs) {
    const std::string ending = std::filesystem::path(path).extension().string();
    auto file =
        region_file(ending.empty() ? ending : ending.substr(1), series, region, {}, options.asked);
    if (!file) return fail(of_file(file.error(), path));
    outputs.push_back({path, {}, file->text});
    files.push_back({path, std::move(*file)});
  }
  const auto done = write_files(outputs);
  OBVID_TRY(done);
  return files;
}

/// A worksheet, made and written.
struct Worksheet {
  PointSeries series;
  RegionTable region;
  std::vector<NamedFile> files;
};

/// Warnings are told of what fails, too; `at_length`: with all that may be said of why it does.
Result<Worksheet> worksheet_of(const RegionOptions& options, bool at_length,
                               std::vector<std::string>& warnings) {
  Result<PointSeries> series = series_of(options);
  OBVID_TRY(series);
  warnings = series->warnings;
  Result<RegionTable> region = region_table(*series, options.job);
  if (!region && at_length) return fail(explained(*series, options.job, region.error(), {}));
  OBVID_TRY(region);
  warnings.insert(warnings.end(), region->warnings.begin(), region->warnings.end());
  auto files = write_worksheet(*series, *region, options);
  OBVID_TRY(files);
  return Worksheet{std::move(*series), std::move(*region), std::move(*files)};
}

Summary summary_of_region(const RegionOptions& options) {
  Summary out;
  const auto made = worksheet_of(options, false, out.warnings);
  if (!made) {
    out.error = made.error();
    return out;
  }
  out.cells = summary_cells(made->series, made->region);
  out.verdict = "as told";
  return out;
}

int region_of_several(const RegionOptions& options) {
  return run_each(options, options.import, true, options.outputs,
                  [&](const OneOf& one, const std::vector<std::string>& outputs) {
                    return summary_of_region(options_of_one(options, one, outputs));
                  });
}

}  // namespace

int run(const RegionOptions& options) {
  if (are_several(options.inputs, options.import.curve)) return region_of_several(options);
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  std::vector<std::string> warnings;
  const auto made = worksheet_of(options, true, warnings);
  warn(warnings);
  if (!made) return report(made.error());
  const auto& [series, region, files] = *made;
  std::string text;
  if (options.json) {
    auto json = region_json(series, region, {});
    if (!json) return report(json.error());
    text = std::move(*json);
  } else if (options.csv) {
    auto table = region_file("csv", series, region);
    if (!table) return report(table.error());
    text = std::move(table->text);
  } else if (!options.quiet) {
    text = region_text(series, region);
    for (const auto& [path, file] : files) {
      text +=
          fmt::format("written        {}{}\n", path, file.remark.empty() ? "" : ": " + file.remark);
    }
  }
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
