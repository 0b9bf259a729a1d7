// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/progress.h"
#include "obvid/core/result.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/surface_export.h"
#include "outputs.h"

namespace obvid {

/// Formats by endings. Errors: E202 for endings without format, E203 where an input would be
/// replaced.
[[nodiscard]] Result<std::vector<Output>> surface_outputs_of(
    const std::vector<std::string>& paths, const std::vector<std::string>& inputs);

/// Forms all texts, then writes all files, each whole or not at all. `warnings` get what may be
/// wrong about them.
[[nodiscard]] Result<Written> write_surface(const SurfaceModel& model,
                                            const std::vector<Output>& outputs,
                                            const SurfaceExportOptions& options,
                                            const Progress& progress,
                                            std::vector<std::string>& warnings);

}  // namespace obvid
