// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/pipeline/alignment_job.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// `obvid alignment`: few lines, arcs and clothoids within a tolerance.
struct AlignmentCommand {
  std::string input;
  std::vector<std::string> inputs;  ///< several, in place of one
  std::vector<std::string> outputs;
  std::string deviations;     ///< .csv of all points; empty: none
  std::string heights;        ///< file of stations and heights; empty: the column z
  std::string profile_table;  ///< .csv of grades and vertical curves; empty: none
  AlignmentJob job;
  std::string asked;  ///< what was typed, for pages
  ImportOptions import;
  std::optional<Units> units;
  bool csv = false;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
