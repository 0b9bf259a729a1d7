// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "fit_report.h"
#include "obvid/io/atomic_file.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/picture_svg.h"
#include "obvid/io/read_points.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

enum class Format { kJson, kSvg };

struct Output {
  std::string path;
  Format format = Format::kJson;
  std::string text;
};

Result<Output> output_of(const std::string& path, const std::string& input) {
  namespace fs = std::filesystem;
  std::string ending = fs::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code ignored;
  if (path == input || fs::equivalent(path, input, ignored)) {
    return fail(
        {ErrorCode::kBadOption, "the output would replace the input", path, "choose another name"});
  }
  if (ending == ".json") return Output{path, Format::kJson, {}};
  if (ending == ".svg") return Output{path, Format::kSvg, {}};
  return fail({ErrorCode::kUnknownFormat,
               ending.empty() ? "the name has no ending that tells a format"
                              : "no format is known for the ending " + ending,
               path, "possible are .json (contour) and .svg (picture)"});
}

Result<std::vector<Output>> outputs_of(const FitOptions& options) {
  std::vector<Output> outputs;
  for (const std::string& path : options.outputs) {
    Result<Output> output = output_of(path, options.input);
    if (!output) return fail(output.error());
    outputs.push_back(std::move(*output));
  }
  return outputs;
}

/// All texts first, then all files: a failure to form leaves every file as it was.
Result<std::vector<std::string>> write_outputs(std::vector<Output>& outputs,
                                               const StoredContour& stored) {
  for (Output& output : outputs) {
    output.text = output.format == Format::kJson ? contour_to_json(stored) : picture_svg(stored);
  }
  std::vector<std::string> written;
  for (const Output& output : outputs) {
    if (auto done = write_file(output.path, output.text); !done) return fail(done.error());
    written.push_back(output.path);
  }
  return written;
}

/// An error about points that no monotone curve meets names how far they would have to move.
Error with_move(Error error, const std::string& units) {
  if (error.code != ErrorCode::kNoSpiral || !(error.value > 0.0) || std::isinf(error.value)) {
    return error;
  }
  error.where += fmt::format("{}about {} {}", error.where.empty() ? "" : ", ",
                             significant(error.value, 2), units);
  return error;
}

/// Arcs have radii between those that a smooth contour has: a given one is aimed at, not met.
void warn_of_radius(const char* end, const std::optional<double>& asked, double kappa,
                    const std::string& units, std::vector<std::string>& warnings) {
  if (!asked || *asked == kappa) return;
  warnings.push_back(
      fmt::format("the arc at the {} has radius {} {}, not {}: arcs meet the given heading, and a "
                  "given radius only in the limit",
                  end, radius_text(kappa), units, radius_text(*asked)));
}

void warn_of_radii(const FitJob& job, Fit& made) {
  if (job.carrier != Carrier::kArcs || made.contour.joints.empty()) return;
  const std::vector<Joint>& joints = made.contour.joints;
  const std::string& units = made.contour.units;
  warn_of_radius("start", job.start_kappa, joints.front().element.kappa, units, made.warnings);
  warn_of_radius("end", job.end_kappa, joints.back().element.kappa, units, made.warnings);
}

Result<Fit> read_and_fit(const FitOptions& options, std::string& name, ProgressBar& bar) {
  bar.tell("reading", 0.0);
  Result<PointSeries> series = read_points(options.input);
  if (!series) return fail(series.error());
  if (options.units) series->units = *options.units;
  name = series->name;
  Result<Fit> made = fit(*series, options.job, bar.progress());
  if (made) {
    warn_of_radii(options.job, *made);
    return made;
  }
  bar.clear();
  warn(series->warnings);  // a formed contour carries them itself
  return fail(with_move(made.error(), series->units));
}

/// Exit code 5 for what was formed but does not keep its promise.
int judge(const Fit& made, bool files) {
  const std::string hint = files ? "the files were written, with this verdict in them" : "";
  if (!made.certificate.proved) {
    return report({ErrorCode::kNotProved,
                   "the contour was formed but not proved: " + made.certificate.reason, "", hint});
  }
  if (made.report.largest_width > made.report.tolerance) {
    return report({ErrorCode::kToleranceNotReached,
                   fmt::format("the region is {} wide, the tolerance is {}",
                               significant(made.report.largest_width, 4),
                               significant(made.report.tolerance, 4)),
                   "", hint});
  }
  return 0;
}

}  // namespace

int run(const FitOptions& options) {
  Result<std::vector<Output>> outputs = outputs_of(options);
  if (!outputs) return report(outputs.error());
  std::string name;
  ProgressBar bar(options.progress && !options.quiet);
  Result<Fit> made = read_and_fit(options, name, bar);
  if (!made) {
    bar.clear();
    return report(made.error());
  }

  std::vector<std::string> written;
  if (!outputs->empty()) {
    bar.tell("writing", 1.0);
    StoredContour stored{std::move(made->contour), made->report, made->certificate};
    Result<std::vector<std::string>> done = write_outputs(*outputs, stored);
    if (!done) {
      bar.clear();
      return report(done.error());
    }
    written = std::move(*done);
    made->contour = std::move(stored.contour);
  }
  bar.clear();
  warn(made->warnings);
  std::string text;
  if (options.json) {
    text = fit_report_json(*made, written);
  } else if (!options.quiet) {
    text = fit_report_text(name, *made, written);
  }
  if (auto done = put(text); !done) return report(done.error());
  return judge(*made, !written.empty());
}

}  // namespace obvid
