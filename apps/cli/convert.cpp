// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

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
Result<StoredContour> from_drawing(const ConvertOptions& options,
                                   std::vector<std::string>& remarks) {
  const Result<Drawing> drawing = read_drawing(options.input);
  if (!drawing) return fail(drawing.error());
  const auto chosen = chosen_curve(*drawing, options.import.curve, options.input);
  if (!chosen) return fail(chosen.error());
  if (*chosen >= drawing->curves.size()) {
    return fail({ErrorCode::kUnsupported, "this is a series of points, not a curve", options.input,
                 "use `obvid fit`, or --curve N with another one", -1, 0.0});
  }
  const DrawnCurve& curve = drawing->curves[*chosen];
  remarks = drawing->warnings;
  remarks.push_back(fmt::format("{}: curve {} of {}, {}", options.input, *chosen + 1,
                                drawing->curves.size(), curve.label));
  CurveAudit audited = audit(curve, drawing->units);
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
  const Result<StoredContour> stored =
      is_foreign(options.input) ? from_drawing(options, remarks) : from_contour(options);
  if (!stored) return report(stored.error());
  const Result<std::vector<Output>> texts = exported(*outputs, *stored, options.formats, remarks);
  if (!texts) return report(texts.error());
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
