// SPDX-License-Identifier: Apache-2.0
#include "surface_outputs.h"

#include <utility>

#include "obvid/core/files.h"

namespace obvid {

Result<std::vector<SurfaceOutput>> surface_outputs_of(const std::vector<std::string>& paths,
                                                      const std::vector<std::string>& inputs) {
  OBVID_TRY(check_outputs(paths, inputs));
  std::vector<SurfaceOutput> outputs;
  for (const std::string& path : paths) {
    const auto format = surface_format_of(path);
    if (!format) {
      return error(ErrorCode::kUnknownFormat, "no format has this file extension")
          .where(path)
          .hint("possible file extensions are " + known_surface_endings());
    }
    outputs.push_back({path, *format});
  }
  return outputs;
}

Result<Written> write_surface(const SurfaceModel& model, const std::vector<SurfaceOutput>& outputs,
                              const SurfaceExportOptions& options, const Progress& progress,
                              std::vector<std::string>& warnings) {
  SurfaceExporter exporter(model, options, progress);
  Written written;
  std::vector<std::string> texts;
  for (const SurfaceOutput& output : outputs) {
    auto text = exporter.text(output.format, written.remarks);
    OBVID_TRY(text);
    texts.push_back(std::move(*text));
  }
  warnings.insert(warnings.end(), exporter.warnings().begin(), exporter.warnings().end());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    OBVID_TRY(write_file(outputs[i].path, texts[i]));
    written.files.push_back(outputs[i].path);
  }
  return written;
}

}  // namespace obvid
