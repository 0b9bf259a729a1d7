// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/internal/drawn_contour.h"
#include "obvid/pipeline/stored.h"
#include "outputs.h"
#include "space_fit.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

bool is_foreign(const std::string& input) { return is_drawing(input) && !input.ends_with(".json"); }

/// A curve of a drawing as it is, with what can be proved about it.
Result<StoredContour> from_drawing(const ConvertOptions& options, ExportOptions& formats,
                                   std::vector<std::string>& remarks) {
  const Result<Drawing> drawing = read_drawing(options.input);
  OBVID_TRY(drawing);
  auto drawn = drawn_contour(*drawing, options.import, options.input);
  OBVID_TRY(drawn);
  remarks = std::move(drawn->remarks);
  formats.name = std::move(drawn->name);
  formats.picture = std::move(drawn->picture);
  return std::move(drawn->stored);
}

int convert(const ConvertOptions& options, Result<StoredContour> stored,
            std::vector<std::string> remarks, ExportOptions formats) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return report(outputs.error());
  if (!stored) return report(stored.error());
  if (options.units) {
    if (auto told = take_units(stored->contour.units, *options.units)) warn({*told});
  }
  FileNotes notes;
  const Result<std::vector<Output>> texts = exported(*outputs, *stored, formats, notes);
  if (!texts) return report(texts.error());
  warn(notes.warnings);
  remarks.insert(remarks.end(), notes.remarks.begin(), notes.remarks.end());
  const Result<std::vector<std::string>> written = write_files(*texts, options.input);
  if (!written) return report(written.error());
  std::string shown;
  if (!options.quiet) {
    if (!options.profile.empty()) shown += options.profile + "\n";
    for (const std::string& remark : remarks) shown += remark + "\n";
    shown += "written  " + listed(*written) + "\n";
  }
  if (auto done = put(shown); !done) return report(done.error());
  return 0;
}

}  // namespace

int run(const ConvertOptions& options) {
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  ExportOptions formats = options.formats;
  if (options.input != "-") {
    formats.picture.name = std::filesystem::path(options.input).filename().string();
  }
  if (!is_foreign(options.input)) {
    const Result<std::string> text = read_file(options.input);
    if (!text) return report(text.error());
    const std::string name = options.input == "-" ? "standard input" : options.input;
    Result<Stored> stored = parse_stored(*text, name);
    if (!stored) return report(stored.error());
    if (const auto* chain = std::get_if<StoredSpaceChain>(&*stored)) {
      return convert_in_space(*chain, options);
    }
    return convert(options, std::get<StoredContour>(std::move(*stored)), {}, std::move(formats));
  }
  std::vector<std::string> remarks;
  auto stored = from_drawing(options, formats, remarks);
  return convert(options, std::move(stored), std::move(remarks), std::move(formats));
}

}  // namespace obvid
