// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "fit_report.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/construction_fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/refusal.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "obvid/pipeline/space_fit.h"
#include "outputs.h"
#include "refusal.h"
#include "series_of.h"
#include "several.h"
#include "space_fit.h"
#include "suggest.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Points that were read, what was formed of them, and what is written with it.
struct Formed {
  PointSeries series;
  Result<Fit> made;
  ExportOptions formats;
};

Result<Formed> read_and_fit(const FitOptions& options, const RunContext& run) {
  Result<PointSeries> series = series_of(options);
  OBVID_TRY(series);
  ExportOptions formats = options.formats;
  formats.picture.name = series->name;
  formats.name = curve_name(*series, options.name());
  Result<Fit> made = options.construction ? fit_construction(*series, *options.construction, run)
                                          : fit(*series, options.job, run);
  return Formed{std::move(*series), std::move(made), std::move(formats)};
}

/// Of what was not formed; the exit code.
int tell_failure(const FitOptions& options, const PointSeries& series, const Error& failure,
                 ProgressBar& bar) {
  if (!options.construction && category(failure.code) == ErrorCategory::kNoContour) {
    return tell_refusal(options, series, failure, bar);
  }
  Error told = failure;
  if (options.construction) {
    told = explained(series, *options.construction, failure, bar.progress());
  }
  bar.clear();
  if (!options.construction) warn(series.warnings);  // a formed contour carries them itself
  return report(told);
}

/// Exit code 5 for what was formed but does not keep its promise.
int judge_fit(const Fit& made, bool files) {
  auto broken = broken_promise(made);
  if (!broken) return 0;
  if (files) broken->hint = "the files were written, with this verdict in them";
  return report(*broken);
}

/// The files of a formed contour; notes join its remarks and warnings.
Result<std::vector<std::string>> write_contour(Fit& made, const std::vector<Output>& outputs,
                                               const ExportOptions& formats,
                                               const std::string& input,
                                               std::vector<std::string>& remarks) {
  ExportOptions told = formats;
  told.told = {remarks, made.warnings};
  StoredContour stored{std::move(made.contour), made.report, made.certificate};
  // all texts first, then all files: a failure to form leaves every file as it was
  FileNotes notes;
  Result<std::vector<Output>> texts = exported(outputs, stored, told, notes);
  made.contour = std::move(stored.contour);
  OBVID_TRY(texts);
  auto done = write_files(*texts, input);
  OBVID_TRY(done);
  for (std::string& remark : notes.remarks) remarks.push_back(std::move(remark));
  for (std::string& warning : notes.warnings) made.warnings.push_back(std::move(warning));
  return done;
}

/// One of several: what a line says of it.
Summary summary_of_fit(const FitOptions& all, const OneOf& one,
                       const std::vector<std::string>& outputs,
                       std::vector<TitledContour>* together) {
  Summary out;
  const auto failed = [&](const Error& error) {
    out.error = error;
    return out;
  };
  const FitOptions options = options_of_one(all, one);
  const auto spatial = space_series(options.input, options.along.has_value(), options.import);
  if (!options.flat && spatial && *spatial) {
    return failed({ErrorCode::kBadOption, "points in space are formed one file at a time",
                   options.input, "--flat forms the contours in the plane of x and y"});
  }
  auto formed = read_and_fit(options, {});
  if (!formed) return failed(formed.error());
  auto& [series, made, formats] = *formed;
  if (!made) {
    out.warnings = series.warnings;
    return failed(made.error());
  }
  const auto wanted = outputs_of(outputs, options.input);
  if (!wanted) return failed(wanted.error());
  const auto written = write_contour(*made, *wanted, formats, options.input, out.warnings);
  if (!written) return failed(written.error());
  out.warnings = made->warnings;
  out.cells = summary_cells(*made);
  for (SummaryCell& cell : airfoil_cells(*written)) out.cells.push_back(std::move(cell));
  out.verdict = made->certificate.proved ? "proved" : "formed";
  if (!options.construction) out.error = broken_promise(*made);
  if (together != nullptr) {
    together->push_back(titled_contour(std::move(*made), series, options.name()));
    name_for_all(one, together->back());
  }
  return out;
}

int fit_several(const FitOptions& options) {
  return run_contours(options, true, summary_form(options.csv, options.json, options.quiet),
                      [&](const OneOf& one, const std::vector<std::string>& files,
                          std::vector<TitledContour>* together) {
                        return summary_of_fit(options, one, files, together);
                      });
}

}  // namespace

int run(const FitOptions& given) {
  warn(given.idle);
  if (auto able = can_write_all(given.outputs); !able) return report(able.error());
  if (are_several(given.inputs, given.import.curve)) return fit_several(given);
  FitOptions options = given;
  if (options.input == "-") {
    Result<std::string> text = read_file(options.input);
    if (!text) return report(text.error());
    options.text = std::move(*text);
  }
  if (const auto done = run_in_space(options)) return *done;
  if (options.suggest) return suggest(options);
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(options.progress && !options.quiet);
  bar.tell("reading", 0.0);
  auto formed = read_and_fit(options, bar.progress());
  if (!formed) {
    bar.clear();
    return report(formed.error());
  }
  auto& [series, made, formats] = *formed;
  if (!made) return tell_failure(options, series, made.error(), bar);

  Written written;
  if (!options.profile.empty()) written.remarks.push_back(options.profile);
  if (!outputs->empty()) {
    bar.tell("writing", 1.0);
    auto done = write_contour(*made, *outputs, formats, options.input, written.remarks);
    if (!done) {
      bar.clear();
      return report(done.error());
    }
    written.files = std::move(*done);
  }
  bar.clear();
  warn(made->warnings);
  std::string text;
  if (options.json) {
    text = fit_report_json(*made, written);
  } else if (options.csv) {
    text = fit_report_csv(*made);
  } else if (!options.quiet) {
    text = fit_report_text(formats.picture.name, *made, written);
  }
  if (auto done = put(text); !done) return report(done.error());
  // a construction promises nothing: its verdict says what it is
  if (options.construction) return 0;
  return judge_fit(*made, !written.files.empty());
}

}  // namespace obvid
