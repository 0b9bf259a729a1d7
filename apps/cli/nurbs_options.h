// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/pipeline/nurbs_job.h"

namespace obvid {

/// `obvid nurbs`: a curve or surface of control points, weights and knots.
struct NurbsOptions {
  std::string input;
  std::vector<std::string> outputs;
  NurbsJob job;
  std::optional<Units> units;
  std::size_t samples = 200;  ///< rows of a .csv
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
