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
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/refusal.h"
#include "outputs.h"
#include "refusal.h"
#include "space_fit.h"
#include "suggest.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// The formed contour, or the exit code of what was reported instead.
struct Outcome {
  std::optional<Fit> made;
  int code = 0;
};

Outcome read_and_fit(const FitOptions& options, ExportOptions& formats, ProgressBar& bar) {
  const auto stop = [&](const Error& error) {
    bar.clear();
    return Outcome{std::nullopt, report(error)};
  };
  bar.tell("reading", 0.0);
  Result<PointSeries> series = options.text
                                   ? parse_series(*options.text, options.name(), options.import)
                                   : read_series(options.input, options.import);
  if (!series) return stop(series.error());
  if (options.units) take_units(*series, *options.units);
  formats.picture.name = series->name;
  if (!series->label.empty()) formats.name = series->label;
  Result<Fit> made = options.construction
                         ? fit_construction(*series, *options.construction, bar.progress())
                         : fit(*series, options.job, bar.progress());
  if (made) return {std::move(*made), 0};
  if (options.construction) {
    return stop(explained(*series, *options.construction, made.error(), bar.progress()));
  }
  if (category(made.error().code) == ErrorCategory::kNoContour) {
    return {std::nullopt, tell_refusal(options, *series, made.error(), bar)};
  }
  bar.clear();
  warn(series->warnings);  // a formed contour carries them itself
  return stop(made.error());
}

/// Exit code 5 for what was formed but does not keep its promise.
int judge_fit(const Fit& made, bool files) {
  auto broken = broken_promise(made);
  if (!broken) return 0;
  if (files) broken->hint = "the files were written, with this verdict in them";
  return report(*broken);
}

}  // namespace

int run(const FitOptions& given) {
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
  ExportOptions formats = options.formats;
  ProgressBar bar(options.progress && !options.quiet);
  auto [made, code] = read_and_fit(options, formats, bar);
  if (!made) return code;

  Written written;
  if (!options.profile.empty()) written.remarks.push_back(options.profile);
  if (!outputs->empty()) {
    bar.tell("writing", 1.0);
    StoredContour stored{std::move(made->contour), made->report, made->certificate};
    // all texts first, then all files: a failure to form leaves every file as it was
    FileNotes notes;
    Result<std::vector<Output>> texts = exported(*outputs, stored, formats, notes);
    Result<std::vector<std::string>> done =
        texts ? write_files(*texts, options.input)
              : Result<std::vector<std::string>>(fail(texts.error()));
    if (!done) {
      bar.clear();
      return report(done.error());
    }
    written.files = std::move(*done);
    for (std::string& remark : notes.remarks) written.remarks.push_back(std::move(remark));
    for (std::string& warning : notes.warnings) made->warnings.push_back(std::move(warning));
    made->contour = std::move(stored.contour);
  }
  bar.clear();
  warn(made->warnings);
  std::string text;
  if (options.json) {
    text = fit_report_json(*made, written);
  } else if (!options.quiet) {
    text = fit_report_text(formats.picture.name, *made, written);
  }
  if (auto done = put(text); !done) return report(done.error());
  // a construction promises nothing: its verdict says what it is
  if (options.construction) return 0;
  return judge_fit(*made, !written.files.empty());
}

}  // namespace obvid
