// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/summary.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "outputs.h"
#include "terminal.h"

namespace obvid {

// Several inputs of one command, or every curve of a drawing: a line each, and a last one.

/// One of several.
struct OneOf {
  std::string input;
  std::optional<std::size_t> curve;  ///< of a drawing, from 0
  std::string id;  ///< in names of outputs: name of the file, and the curve's number

  [[nodiscard]] std::string shown() const;
};

/// How lines look.
enum class SummaryForm { kText, kCsv, kJson, kNothing };

[[nodiscard]] SummaryForm summary_form(bool csv, bool json, bool quiet);

/// Whether a command has more than one thing to do.
[[nodiscard]] bool are_several(const std::vector<std::string>& inputs, const CurveChoice& curve);

/// All of them; `points`: series of points of drawings count beside curves (waypoints never), else
/// a warning tells that they do not. Errors: those of reading a drawing whose curves are asked for.
[[nodiscard]] Result<std::vector<OneOf>> all_of_them(const std::vector<std::string>& inputs,
                                                     const std::string& input,
                                                     const ImportOptions& import, bool points);

/// The names of outputs for one of them. Error: E203 without `{id}`.
[[nodiscard]] Result<std::vector<std::string>> outputs_for(const std::vector<std::string>& outputs,
                                                           const OneOf& one);

/// Outputs of several contours: a file for each, and files that hold all of them.
struct SeveralOutputs {
  std::vector<std::string> each;  ///< with `{id}`
  std::vector<Output> together;
};

/// Which is which. Errors: E202; E203 a name without `{id}` of a format that holds one contour;
/// E310.
[[nodiscard]] Result<SeveralOutputs> several_outputs(const std::vector<std::string>& outputs,
                                                     const ExportOptions& options);

/// What a contour of no name is called among others: as its input.
void name_for_all(const OneOf& one, TitledContour& contour);

/// Writes the files that hold all; a line for each. Warnings are printed. Errors: those of
/// `export_together`, and of writing.
[[nodiscard]] Result<std::vector<std::string>> write_together(
    const std::vector<TitledContour>& contours, const std::vector<Output>& outputs,
    const ExportOptions& options);

/// Does `work` for each, prints its line, then how many were fine; the exit code is that of the
/// first that was not.
class Several {
 public:
  Several(std::vector<OneOf> all, SummaryForm form) : all_(std::move(all)), form_(form) {}

  template <class Work>
  int run(const std::vector<std::string>& outputs, const Work& work) {
    return run({outputs, {}}, work, [](const auto&) { return std::vector<std::string>{}; });
  }

  /// The same; `all` gets the files that hold all when each is done, and says a line for each.
  template <class Work, class All>
  int run(const SeveralOutputs& outputs, const Work& work, const All& all) {
    if (auto error = check(outputs)) return refused(*error);
    for (const OneOf& one : all_) {
      const auto names = outputs_for(outputs.each, one);
      if (!names) return refused(names.error());
      if (const int code = tell(one, work(one, *names)); code != 0) return code;
    }
    if (outputs.together.empty()) return end({});
    const Result<std::vector<std::string>> lines = all(outputs.together);
    if (!lines) return refused(lines.error());
    return end(*lines);
  }

 private:
  [[nodiscard]] std::optional<Error> check(const SeveralOutputs& outputs) const;
  static int refused(const Error& error);
  int tell(const OneOf& one, Summary summary);
  std::string csv_lines(const std::string& name, Summary summary);
  int end(const std::vector<std::string>& lines);

  std::vector<OneOf> all_;
  SummaryForm form_;
  std::vector<SummaryCell> columns_;                      ///< of the first that has figures
  std::vector<std::pair<std::string, Summary>> waiting_;  ///< without figures, before these
  std::size_t fine_ = 0;
  std::optional<Error> first_;
};

/// What was asked for, of one of several; its outputs where the command has them.
template <class Options>
[[nodiscard]] Options options_of_one(Options options, const OneOf& one) {
  options.input = one.input;
  if constexpr (requires { options.import.curve; }) {
    if (one.curve) options.import.curve = {one.curve, {}, false};
  }
  return options;
}
template <class Options>
[[nodiscard]] Options options_of_one(Options options, const OneOf& one,
                                     const std::vector<std::string>& outputs) {
  options.outputs = outputs;
  return options_of_one(std::move(options), one);
}

/// `work(one, outputs)` for each of a command's inputs, with its own `outputs`. `points`: as for
/// `all_of_them`.
template <class Options, class Work>
int run_each(const Options& options, const ImportOptions& import, bool points,
             const std::vector<std::string>& outputs, const Work& work) {
  const auto all = all_of_them(options.inputs, options.input, import, points);
  if (!all) return report(all.error());
  return Several(*all, summary_form(options.csv, options.json, options.quiet)).run(outputs, work);
}

/// `work(one, files, together)` for each contour, with where to leave it for files of all of them;
/// nowhere without such files.
template <class Options, class Work>
int run_contours(const Options& options, bool points, SummaryForm form, const Work& work) {
  const auto all = all_of_them(options.inputs, options.input, options.import, points);
  if (!all) return report(all.error());
  const auto outputs = several_outputs(options.outputs, options.formats);
  if (!outputs) return report(outputs.error());
  std::vector<TitledContour> contours;
  std::vector<TitledContour>* together = outputs->together.empty() ? nullptr : &contours;
  return Several(*all, form)
      .run(
          *outputs,
          [&](const OneOf& one, const std::vector<std::string>& files) {
            return work(one, files, together);
          },
          [&](const std::vector<Output>& files) {
            return write_together(contours, files, options.formats);
          });
}

}  // namespace obvid
