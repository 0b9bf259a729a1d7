// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "obvid/core/internal/watch.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/no_such_file.h"

namespace obvid {
namespace {

Result<std::string> drawn_paths(FileFormat format, const MadeCut& made, const CutJob& job,
                                const RunContext& run) {
  Watch watch(run);
  const Sketch sketch = cut_sketch(made, job);
  std::string text =
      format == FileFormat::kPicture ? sketch_svg(sketch, &watch) : sketch_dxf(sketch, &watch);
  if (watch.was_cancelled()) return fail(cancelled_error());
  return text;
}

}  // namespace

Result<std::string> cut_file(FileFormat format, const MadeCut& made, const CutJob& job,
                             const RunContext& run) {
  switch (format) {
    case FileFormat::kGcode:
      return made.program.text;
    case FileFormat::kSamples:
      return csv_text(cut_rows(made));
    case FileFormat::kPicture:
    case FileFormat::kDxf:
      return drawn_paths(format, made, job, run);
    default:
      return no_such_file("a cut", known_cut_endings());
  }
}

}  // namespace obvid
