// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid::pipeline_detail {

/// Sections in the order of the inputs; `assumed` and errors: of `read_sections`.
[[nodiscard]] Result<std::vector<SpaceSeries>> sections_of(const std::vector<SurfaceInput>& inputs,
                                                           std::optional<double> spacing,
                                                           std::vector<std::string>* assumed,
                                                           const RunContext& run);
/// The one section of an input. Error: E307 there are more.
[[nodiscard]] Result<SpaceSeries> section_of(const SurfaceInput& input, const RunContext& run);
/// Errors: of `read_grid`; E203 points that do not fill rows.
[[nodiscard]] Result<PointGrid> grid_of(const std::vector<SurfaceInput>& inputs,
                                        const GridReading& reading);

}  // namespace obvid::pipeline_detail
