// SPDX-License-Identifier: Apache-2.0
// One series: made, given to the program, and all that it said judged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sheet.h"

namespace judge {

struct TrialOptions {
  std::string obvid;       ///< the program
  std::string folder;      ///< to work in; emptied
  std::string of = "fit";  ///< what is tried: fit, scan, space, nurbs, spline, region
  std::uint64_t seed = 1;
  double limit = 10.0;  ///< seconds of processor time of one run
};

struct Trial {
  enum class Outcome { kFine, kFalse, kCrash, kTimeout, kRefused, kBadRefusal };
  std::uint64_t index = 0;
  Outcome outcome = Outcome::kFine;
  std::string family, command;
  std::size_t points = 0;
  Sheet sheet;
  double program_seconds = 0.0, judge_seconds = 0.0, slowest = 0.0;
};
const char* name_of(Trial::Outcome outcome);

Trial run_trial(const TrialOptions& options, std::uint64_t index);
/// Points in space for `fit`, control points for `nurbs`, tables of x, y, f for `spline`.
Trial run_space_trial(const TrialOptions& options, std::uint64_t index);
Trial run_nurbs_trial(const TrialOptions& options, std::uint64_t index);
Trial run_grid_trial(const TrialOptions& options, std::uint64_t index);
/// Points and headings for `region`, its constructions and what its ranges promise of `fit`.
Trial run_region_trial(const TrialOptions& options, std::uint64_t index);
/// Measured points for `fit`: outliers, points in no order, errors of known size.
Trial run_scan_trial(const TrialOptions& options, std::uint64_t index);

/// All claims of a file of format obvid-space-curve, and of the printed report if there is one.
void judge_space(const std::string& stored, const std::string& report, Sheet& sheet);
/// All claims of a contour file itself.
void judge_contour(const std::string& text, Sheet& sheet);

}  // namespace judge
