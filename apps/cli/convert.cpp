// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "commands.h"
#include "interrupt.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "obvid/pipeline/stored.h"
#include "outputs.h"
#include "several.h"
#include "space_fit.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

Result<Convertible> read_input(const ConvertOptions& options, const RunContext& run) {
  const ConvertJob job{options.import, options.units};
  if (options.input != "-") return read_convertible(options.input, job, run);
  const auto text = read_file(options.input);
  OBVID_TRY(text);
  auto read = parse_convertible(*text, "standard input", job, run);
  OBVID_TRY(read);
  auto* const contour = std::get_if<TitledContour>(&*read);
  // a pipe has no name that pictures could bear
  if (contour != nullptr && contour->picture.name == contour->source) contour->picture.name.clear();
  return read;
}

struct Converted {
  std::vector<std::string> files;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

Result<Converted> converted(const ConvertOptions& options, Result<TitledContour> contour,
                            const RunContext& run) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  OBVID_TRY(outputs);
  OBVID_TRY(contour);
  ExportOptions formats = options.formats;
  set_titles(*contour, options.profile, formats);
  if (options.input == "-" && formats.picture.name == "standard input")
    formats.picture.name.clear();
  FileNotes notes;
  const Result<std::vector<Output>> texts =
      exported(*outputs, contour->stored, formats, notes, run);
  OBVID_TRY(texts);
  Converted out;
  out.warnings = std::move(contour->warnings);
  out.remarks = std::move(contour->remarks);
  out.warnings.insert(out.warnings.end(), notes.warnings.begin(), notes.warnings.end());
  Result<std::vector<std::string>> written = write_files(*texts, options.input);
  OBVID_TRY(written);
  out.files = std::move(*written);
  out.remarks.insert(out.remarks.end(), notes.remarks.begin(), notes.remarks.end());
  return out;
}

int tell(const ConvertOptions& options, const Result<Converted>& done) {
  if (!done) return report(done.error());
  warn(done->warnings);
  std::string shown;
  if (!options.quiet) {
    if (!options.profile.empty()) shown += options.profile + "\n";
    for (const std::string& remark : done->remarks) shown += remark + "\n";
    shown += "written  " + listed(done->files) + "\n";
  }
  if (auto put_out = put(shown); !put_out) return report(put_out.error());
  return 0;
}

/// One of several: its own files, and itself for those that hold all.
Summary summary_of_files(const ConvertOptions& all, const OneOf& one,
                         const std::vector<std::string>& outputs,
                         std::vector<TitledContour>* together) {
  Summary out;
  const ConvertOptions options = options_of_one(all, one, outputs);
  Result<TitledContour> contour = [&]() -> Result<TitledContour> {
    auto read = read_input(options, {});
    OBVID_TRY(read);
    if (auto* plane = std::get_if<TitledContour>(&*read)) return std::move(*plane);
    return error(ErrorCode::kUnsupported, "curves in space are converted one file at a time")
        .where(options.input);
  }();
  if (contour && together != nullptr) {
    together->push_back(*contour);
    name_for_all(one, together->back());
  }
  const std::string name = contour ? contour->name : "";
  const auto done = converted(options, std::move(contour), {});
  if (!done) {
    out.error = done.error();
    return out;
  }
  out.warnings = done->warnings;
  out.cells = airfoil_cells(done->files);
  out.verdict = done->files.empty() ? name : "written " + listed(done->files);
  return out;
}

int convert_several(const ConvertOptions& options) {
  const bool edges = options.import.use == DrawnUse::kExact;
  return run_contours(options, edges, summary_form(false, false, options.quiet),
                      [&](const OneOf& one, const std::vector<std::string>& files,
                          std::vector<TitledContour>* together) {
                        return summary_of_files(options, one, files, together);
                      });
}

}  // namespace

int run(const ConvertOptions& options) {
  warn(options.idle);
  if (auto able = can_write_all(options.outputs); !able) return report(able.error());
  if (are_several(options.inputs, options.import.curve)) return convert_several(options);
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const Interrupt interrupt;
  const RunContext context({}, [&interrupt] { return interrupt.asked(); });
  Result<Convertible> read = read_input(options, context);
  if (!read) return tell(options, converted(options, fail(read.error()), context));
  if (const auto* chain = std::get_if<StoredSpaceChain>(&*read)) {
    return convert_in_space(*chain, options);
  }
  return tell(options, converted(options, std::get<TitledContour>(std::move(*read)), context));
}

}  // namespace obvid
