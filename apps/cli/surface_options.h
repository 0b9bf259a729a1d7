// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/surface_check_job.h"
#include "obvid/pipeline/surface_cut_job.h"
#include "obvid/pipeline/surface_export.h"
#include "obvid/pipeline/surface_job.h"

namespace obvid {

/// `obvid surface KIND`: makes a surface and writes it.
struct SurfaceOptions {
  std::string command;  ///< the kind as typed
  SurfaceJob job;
  SurfaceExportOptions formats;
  std::vector<std::string> outputs;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

/// `obvid surface check`
struct SurfaceCheckOptions {
  std::string input;
  std::vector<std::string> inputs;   ///< several, in place of one
  std::vector<std::string> outputs;  ///< pictures and pages of curvature or deviation
  SurfaceCheckJob job;
  SurfaceExportOptions formats;
  bool csv = false;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

/// `obvid surface cut`
struct SurfaceCutOptions {
  std::string input;
  std::vector<std::string> outputs;  ///< points, drawings; with {id} a file for each branch
  SurfaceCutJob job;
  bool csv = false;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
