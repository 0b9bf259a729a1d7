// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"
#include "obvid/io/internal/read_cloud.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid::pipeline_detail {

/// Points of an input, in no order: rows of numbers, or those of a mesh. Errors: of the readers.
[[nodiscard]] Result<PointCloud> cloud_of(const SurfaceInput& input);

/// Whether a file is a stored surface rather than points: JSON, STEP, IGES, BREP, and control
/// points by the ending of their name.
[[nodiscard]] bool holds_surface(const std::string& text, const std::string& name);

}  // namespace obvid::pipeline_detail
