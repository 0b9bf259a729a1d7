// SPDX-License-Identifier: Apache-2.0
#include "surface_outputs.h"

#include <utility>

#include "obvid/core/files.h"

namespace obvid {

Result<std::vector<Output>> surface_outputs_of(const std::vector<std::string>& paths,
                                               const std::vector<std::string>& inputs) {
  OBVID_TRY(check_outputs(paths, inputs));
  std::vector<Output> outputs;
  for (const std::string& path : paths) {
    const auto format = surface_format_of(path);
    if (!format) {
      return error(ErrorCode::kUnknownFormat, "no format has this file extension")
          .where(path)
          .hint("possible file extensions are " + known_surface_endings());
    }
    if (auto able = can_write_surfaces(*format); !able) {
      return fail(of_file(able.error(), path));
    }
    outputs.push_back({path, *format, {}});
  }
  return outputs;
}

Result<Written> write_surface(const SurfaceModel& model, const std::vector<Output>& outputs,
                              const SurfaceExportOptions& options, const Progress& progress,
                              std::vector<std::string>& warnings) {
  SurfaceExporter exporter(model, options, progress);
  Written written;
  std::vector<Output> files;
  for (const Output& output : outputs) {
    auto text = exporter.text(output.format, written.remarks);
    OBVID_TRY(text);
    files.push_back({output.path, output.format, std::move(*text)});
  }
  warnings.insert(warnings.end(), exporter.warnings().begin(), exporter.warnings().end());
  auto names = write_files(files);
  OBVID_TRY(names);
  written.files = std::move(*names);
  return written;
}

}  // namespace obvid
