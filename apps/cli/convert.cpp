// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/drawn_contour.h"
#include "obvid/pipeline/stored.h"
#include "outputs.h"
#include "several.h"
#include "space_fit.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

/// Taken as it is drawn: files of others, and contours that are placed anew, whose claims spoke of
/// another place.
bool is_foreign(const ConvertOptions& options) {
  if (!is_drawing(options.input)) return false;
  return !has_ending(options.input, ".json") || !options.import.placement.changes_nothing();
}

/// A curve of a drawing as it is, with what can be proved about it.
Result<StoredContour> from_drawing(const ConvertOptions& options, ExportOptions& formats,
                                   ToldBeside& told) {
  const Result<Drawing> drawing = read_drawing(options.input, options.import.planes);
  OBVID_TRY(drawing);
  auto drawn = drawn_contour(*drawing, options.import, options.input);
  OBVID_TRY(drawn);
  told = {std::move(drawn->remarks), std::move(drawn->warnings)};
  formats.name = std::move(drawn->name);
  formats.picture = std::move(drawn->picture);
  formats.first_station = drawn->first_station;
  formats.transitions = std::move(drawn->transitions);
  formats.profile = std::move(drawn->profile);
  return std::move(drawn->stored);
}

struct Converted {
  std::vector<std::string> files;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
};

Result<Converted> converted(const ConvertOptions& options, Result<StoredContour> stored,
                            ToldBeside told, ExportOptions formats) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  OBVID_TRY(outputs);
  OBVID_TRY(stored);
  Converted out;
  out.warnings = std::move(told.warnings);
  out.remarks = std::move(told.remarks);
  if (options.units) {
    if (auto other = take_units(stored->contour.units, *options.units)) {
      out.warnings.push_back(*other);
    }
  }
  FileNotes notes;
  formats.told = {out.remarks, out.warnings};
  if (!options.profile.empty()) {
    formats.told.remarks.insert(formats.told.remarks.begin(), options.profile);
  }
  const Result<std::vector<Output>> texts = exported(*outputs, *stored, formats, notes);
  OBVID_TRY(texts);
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

ExportOptions formats_of(const ConvertOptions& options) {
  ExportOptions formats = options.formats;
  if (options.input != "-") {
    formats.picture.name = std::filesystem::path(options.input).filename().string();
  }
  return formats;
}

Summary summary_of_files(const ConvertOptions& all, const OneOf& one,
                         const std::vector<std::string>& outputs) {
  Summary out;
  ConvertOptions options = all;
  options.input = one.input;
  options.outputs = outputs;
  if (one.curve) options.import.curve = {one.curve, {}, false};
  ExportOptions formats = formats_of(options);
  ToldBeside told;
  Result<StoredContour> stored = [&]() -> Result<StoredContour> {
    if (is_foreign(options)) return from_drawing(options, formats, told);
    const auto text = read_file(options.input);
    OBVID_TRY(text);
    auto read = parse_stored(*text, options.input);
    OBVID_TRY(read);
    if (auto* contour = std::get_if<StoredContour>(&*read)) return std::move(*contour);
    return error(ErrorCode::kUnsupported, "curves in space are converted one file at a time")
        .where(options.input);
  }();
  const auto done = converted(options, std::move(stored), std::move(told), std::move(formats));
  if (!done) {
    out.error = done.error();
    return out;
  }
  out.warnings = done->warnings;
  out.cells = airfoil_cells(done->files);
  out.verdict = "written " + listed(done->files);
  return out;
}

int convert_several(const ConvertOptions& options) {
  const bool edges = options.import.use == DrawnUse::kExact;
  const auto all = all_of_them(options.inputs, options.input, options.import, edges);
  if (!all) return report(all.error());
  Several several(*all, summary_form(false, false, options.quiet));
  return several.run(options.outputs,
                     [&](const OneOf& one, const std::vector<std::string>& outputs) {
                       return summary_of_files(options, one, outputs);
                     });
}

}  // namespace

int run(const ConvertOptions& options) {
  warn(options.idle);
  if (are_several(options.inputs, options.import.curve)) return convert_several(options);
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  ExportOptions formats = formats_of(options);
  if (!is_foreign(options)) {
    if (!options.import.placement.changes_nothing()) {
      return report({ErrorCode::kBadOption, "a contour is placed anew when it comes as a file",
                     options.input, "name the file"});
    }
    const Result<std::string> text = read_file(options.input);
    if (!text) return report(text.error());
    const std::string name = options.input == "-" ? "standard input" : options.input;
    Result<Stored> stored = parse_stored(*text, name);
    if (!stored) return report(stored.error());
    if (const auto* chain = std::get_if<StoredSpaceChain>(&*stored)) {
      return convert_in_space(*chain, options);
    }
    return tell(options, converted(options, std::get<StoredContour>(std::move(*stored)), {},
                                   std::move(formats)));
  }
  ToldBeside told;
  auto stored = from_drawing(options, formats, told);
  return tell(options, converted(options, std::move(stored), std::move(told), std::move(formats)));
}

}  // namespace obvid
