// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/pipeline/toolpath_job.h"

namespace obvid {

/// `obvid toolpath`
struct ToolpathCommand {
  std::string input;
  std::vector<std::string> outputs;  ///< G-code, pictures, pages
  ToolpathJob job;
  SurfaceView view = SurfaceView::kIso;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
