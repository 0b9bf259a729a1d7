// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/picture/surface_svg.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/pipeline/toolpath_job.h"
#include "obvid/surface_builders/internal/check.h"

namespace obvid {

// What the jobs on surfaces found, as one JSON object and a line feed: the same for every front
// end. Lengths in the surface's units. Reentrant.

/// What was made.
[[nodiscard]] std::string surface_report_json(const MadeSurface& made, const Written& written);

/// What was measured of each patch and border, and the deviation.
[[nodiscard]] std::string surface_check_json(const SurfaceModel& model,
                                             const CheckedSurface& checked, const Written& written);

/// What the printed program does.
[[nodiscard]] std::string toolpath_report_json(const MadeToolpath& made, const Written& written);

/// Name of a side of a patch: "u start", "u end", "v start", "v end" for 0 to 3.
[[nodiscard]] const char* border_name(PatchSide side);

/// Curvatures of all patches together, as the report has them for each: what pictures tell beside
/// their colours.
[[nodiscard]] CurvatureExtremes extremes_of(const SurfaceCheck& check);

/// The same without the rest of a check, at its default number of samples. Error: E103.
[[nodiscard]] Result<CurvatureExtremes> extremes_of(const SurfaceModel& model,
                                                    const RunContext& run);

}  // namespace obvid
