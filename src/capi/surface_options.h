// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "obvid/core/result.h"
#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_cut_job.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"
#include "obvid/pipeline/toolpath_job.h"

namespace obvid::capi {

/// What the options of a call on surfaces ask for.
struct SurfaceRequest {
  SurfaceJob make;  ///< how contours are formed is in `make.curves.sections`
  SurfaceExportOptions formats;
  ToolpathJob toolpath;
  SurfaceCutJob cut;
  SurfaceCheckJob check;  ///< its `against` also of files
};

/// Which options a call knows.
struct SurfaceKnown {
  std::optional<SurfaceKind> kind{};  ///< a surface of this kind is made
  bool formats = false;               ///< of files
  bool toolpath = false;
  bool check = false;
  bool cut = false;  ///< sections
};

/// As `request_of`, for surfaces.
[[nodiscard]] Result<SurfaceRequest> surface_request_of(const char* options,
                                                        const SurfaceKnown& known);

}  // namespace obvid::capi
