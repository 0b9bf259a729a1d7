// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/pipeline/spline_job.h"

namespace obvid {

/// `obvid spline`: a spline of a function or along points, its figures and files.
struct SplineOptions {
  std::string input;
  std::string finer;  ///< file with more of the same function or curve; empty: none
  std::vector<std::string> outputs;
  SplineJob job;
  std::size_t samples = 200;  ///< rows of a .csv
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

}  // namespace obvid
