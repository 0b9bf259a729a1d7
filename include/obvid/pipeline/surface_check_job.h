// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/surface/surface.h"
#include "obvid/surface_builders/internal/check.h"
#include "obvid/surface_builders/internal/deviation.h"

namespace obvid {

struct SurfaceCheckJob {
  CheckOptions check;
  std::optional<SurfaceInput> against;  ///< points or another surface, to be measured against
};

/// How far a surface and what it is measured against are apart.
struct SurfaceDeviation {
  std::string against;            ///< name of the file or of the points
  bool points = false;            ///< else another surface
  Deviation found;                ///< of the points from the surface; else of the surface from the
                                  ///< other one
  std::optional<Deviation> back;  ///< of the other surface from this one
  ShownDeviation shown;           ///< for pictures and pages
};

struct CheckedSurface {
  SurfaceCheck check;
  std::optional<SurfaceDeviation> deviation;
  std::vector<std::string> warnings;
};

/// Measures a surface, and where there is something to be measured against how far it is away:
/// a mesh file's points, rows of numbers, or a surface. Errors: of the readers; E310 units that are
/// known and differ; E103.
[[nodiscard]] Result<CheckedSurface> check_surface(const SurfaceModel& model,
                                                   const SurfaceCheckJob& job,
                                                   const RunContext& run = {});

/// Pictures and pages show what was found: distances, and where curvature is largest.
void show_findings(const CheckedSurface& checked, SurfaceExportOptions& formats);

/// The same without the check: for pictures alone.
[[nodiscard]] Result<SurfaceDeviation> measured_against(const SurfaceModel& model,
                                                        const SurfaceInput& against,
                                                        std::size_t samples,
                                                        std::vector<std::string>& warnings,
                                                        const RunContext& run);

}  // namespace obvid
