// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/analyse.h"

#include <string>
#include <vector>

#include "audit_report.h"
#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/report_json.h"
#include "outputs.h"
#include "series_of.h"
#include "series_report.h"
#include "several.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

Result<AnalysedSeries> analysed_points(const AnalyseOptions& options) {
  Result<PointSeries> series = series_of(options);
  OBVID_TRY(series);
  Result<Analysis> analysis = analyse(series->points);
  if (!analysis) {
    warn(series->warnings);
    return fail(analysis.error());
  }
  add_rounding_warning(*series, *analysis);
  return AnalysedSeries{std::move(*series), std::move(*analysis)};
}

std::string points_page(const AnalyseOptions& options, const AnalysedSeries& points) {
  ReportPage page;
  page.title = points.series.name;
  page.verdict = "what the points alone say";
  page.figures = {{"asked for", options.asked},
                  {"lengths in", points.series.units.text()},
                  {"points", std::to_string(points.series.points.size())}};
  const Facts facts = series_facts(points.series, points.analysis);
  page.figures.insert(page.figures.end(), facts.lines().begin(), facts.lines().end());
  page.warnings = points.series.warnings;
  page.tables.push_back(
      table_of_page("points", "Points", series_rows(points.series, points.analysis)));
  return page_text(page);
}

Result<std::string> points_file_of(FileFormat format, const AnalyseOptions& options,
                                   const AnalysedSeries& points) {
  if (format != FileFormat::kPage) return analysis_file(format, points);
  return points_page(options, points);
}

/// Tables of points; a picture needs a curve.
Result<std::vector<std::string>> write_tables(const AnalyseOptions& options,
                                              const AnalysedSeries& points) {
  std::vector<Output> files;
  for (const std::string& path : options.outputs) {
    const auto format = analysis_format_of(path);
    OBVID_TRY(format);
    auto text = points_file_of(*format, options, points);
    if (!text) return fail(of_file(text.error(), path));
    files.push_back({path, *format, std::move(*text)});
  }
  return write_files(files, options.input);
}

Summary summary_of_points(const AnalyseOptions& all, const OneOf& one) {
  Summary out;
  out.verdict = "read";
  const AnalyseOptions options = options_of_one(all, one);
  if (is_drawing(one.input)) {
    auto drawing = analysed_drawing(options);
    if (!drawing) {
      out.error = drawing.error();
      return out;
    }
    out.cells = summary_cells(*drawing);
    out.warnings = drawing->drawing.warnings;
    return out;
  }
  const auto points = analysed_points(options);
  if (!points) {
    out.error = points.error();
    return out;
  }
  out.cells = summary_cells(points->series, points->analysis);
  out.warnings = points->series.warnings;
  return out;
}

int analyse_several(const AnalyseOptions& options) {
  if (!options.outputs.empty()) {
    return report({ErrorCode::kBadOption, "a picture or table is of one input",
                   options.outputs.front(), "analyse one file, or leave -o out"});
  }
  return run_each(options, {}, true, {}, [&](const OneOf& one, const std::vector<std::string>&) {
    return summary_of_points(options, one);
  });
}

}  // namespace

Result<FileFormat> analysis_format_of(const std::string& path) {
  return table_format_of(path, "an analysis", ".csv and .json (tables)");
}

int run(const AnalyseOptions& options) {
  if (!options.inputs.empty()) return analyse_several(options);
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  if (is_drawing(options.input)) return audit_drawing(options);
  const auto points = analysed_points(options);
  if (!points) return report(points.error());
  const auto written = write_tables(options, *points);
  warn(points->series.warnings);
  if (!written) return report(written.error());
  std::string text;
  if (options.json) {
    text = series_report_json(points->series, points->analysis);
  } else if (options.csv) {
    text = csv_text(series_rows(points->series, points->analysis));
  } else if (!options.quiet) {
    text = series_report_text(points->series, points->analysis);
    if (!written->empty()) text += "\nwritten  " + listed(*written) + "\n";
  }
  if (auto done = put(text); !done) return report(done.error());
  return 0;
}

}  // namespace obvid
