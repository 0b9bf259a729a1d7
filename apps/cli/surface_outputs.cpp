// SPDX-License-Identifier: Apache-2.0
#include "surface_outputs.h"

#include <utility>

#include "obvid/io/atomic_file.h"

namespace obvid {

Result<std::vector<SurfaceOutput>> surface_outputs_of(const std::vector<std::string>& paths,
                                                      const std::vector<std::string>& inputs) {
  if (auto free = check_outputs(paths, inputs); !free) return fail(free.error());
  std::vector<SurfaceOutput> outputs;
  for (const std::string& path : paths) {
    const auto format = surface_format_of(path);
    if (!format) {
      return fail({ErrorCode::kUnknownFormat, "no format has this file extension", path,
                   "possible file extensions are " + known_surface_endings(), -1, 0.0});
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
    if (!text) return fail(text.error());
    texts.push_back(std::move(*text));
  }
  warnings.insert(warnings.end(), exporter.warnings().begin(), exporter.warnings().end());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (auto done = write_file(outputs[i].path, texts[i]); !done) return fail(done.error());
    written.files.push_back(outputs[i].path);
  }
  return written;
}

}  // namespace obvid
