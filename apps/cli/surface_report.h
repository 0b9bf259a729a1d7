// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_job.h"
#include "surface_outputs.h"

namespace obvid {

/// What was made, for the eye; for programs: obvid/pipeline/internal/surface_report_json.h.
[[nodiscard]] std::string surface_report_text(const MadeSurface& made, const Written& written);

/// What was measured.
[[nodiscard]] std::string surface_check_text(const SurfaceModel& model,
                                             const CheckedSurface& checked, const Written& written);

}  // namespace obvid
