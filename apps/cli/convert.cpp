// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/read_file.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/import.h"
#include "outputs.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

bool is_foreign(const std::string& input) { return is_drawing(input) && !input.ends_with(".json"); }

/// A curve of a drawing as it is, with what can be proved about it.
Result<StoredContour> from_drawing(const ConvertOptions& options, ExportOptions& formats,
                                   std::vector<std::string>& remarks) {
  const Result<Drawing> drawing = read_drawing(options.input);
  if (!drawing) return fail(drawing.error());
  const auto chosen = chosen_curve(*drawing, options.import.curve, options.input);
  if (!chosen) return fail(chosen.error());
  const std::size_t curves = drawing->curves.size();
  if (*chosen >= curves && options.import.use != DrawnUse::kExact) {
    return fail({ErrorCode::kUnsupported, "this is a series of points, not a curve", options.input,
                 "use `obvid fit`, --drawing exact for its edges, or --curve N for another one", -1,
                 0.0});
  }
  remarks = drawing->warnings;
  remarks.push_back(options.input + ": " +
                    chosen_text(*drawing, *chosen, options.import.curve.has_value()));
  CurveAudit audited = audit(*chosen < curves ? drawing->curves[*chosen]
                                              : edges_of(drawing->series[*chosen - curves]),
                             drawing->units);
  formats.name = audited.label;
  formats.picture = {drawing->name + ": " + audited.label, as_drawn(audited)};
  return StoredContour{std::move(audited.contour), std::nullopt, std::move(audited.certificate)};
}

Result<StoredContour> from_contour(const ConvertOptions& options) {
  const Result<std::string> text = read_file(options.input);
  if (!text) return fail(text.error());
  return contour_from_json(*text, options.input == "-" ? "standard input" : options.input);
}

}  // namespace

int run(const ConvertOptions& options) {
  Result<std::vector<Output>> outputs = outputs_of(options.outputs, options.input);
  if (!outputs) return report(outputs.error());
  std::vector<std::string> remarks;
  ExportOptions formats = options.formats;
  if (options.input != "-") {
    formats.picture.name = std::filesystem::path(options.input).filename().string();
  }
  Result<StoredContour> stored =
      is_foreign(options.input) ? from_drawing(options, formats, remarks) : from_contour(options);
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

}  // namespace obvid
