// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/pipeline/cut_job.h"

namespace obvid {

/// `obvid cut`
struct CutCommand {
  std::vector<std::string> inputs;
  std::vector<std::string> outputs;  ///< G-code, pictures
  ImportOptions import;
  CutJob job;
  std::string asked;  ///< what was typed, for pages
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
