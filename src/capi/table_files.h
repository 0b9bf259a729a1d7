// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/format_table.h"

namespace obvid::capi {

/// All files that the table of formats has of a job: its program, where there is one, without a
/// suffix and before the others, which have their file extensions as suffixes. Report pages say
/// what was asked for on the command line, and are its own.
template <class Make>
[[nodiscard]] Result<std::vector<ExportedFile>> files_in_table(pipeline_detail::FilesOf what,
                                                               Make&& make) {
  std::vector<ExportedFile> out;
  for (const pipeline_detail::FormatRow& row : pipeline_detail::kFormats) {
    const std::string is = row.*what;
    if (is.empty() || is == "report page") continue;
    auto text = make(row.format);
    OBVID_TRY(text);
    const bool program = row.format == FileFormat::kGcode;
    out.insert(program ? out.begin() : out.end(),
               {program ? "" : std::string(row.ending()), std::move(*text)});
  }
  return out;
}

}  // namespace obvid::capi
