// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/pipeline/surface_job.h"
#include "obvid/surfacing/check.h"
#include "surface_outputs.h"

namespace obvid {

/// What was made, for the eye and for programs.
[[nodiscard]] std::string surface_report_text(const MadeSurface& made,
                                              const SurfaceWritten& written);
[[nodiscard]] std::string surface_report_json(const MadeSurface& made,
                                              const SurfaceWritten& written);

/// What was measured.
[[nodiscard]] std::string surface_check_text(const SurfaceModel& model, const SurfaceCheck& check,
                                             const SurfaceWritten& written);
[[nodiscard]] std::string surface_check_json(const SurfaceModel& model, const SurfaceCheck& check,
                                             const SurfaceWritten& written);

}  // namespace obvid
