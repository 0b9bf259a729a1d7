// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {

// Options of constructions and of the worksheet, read alike for all front ends.

/// As they were typed.
struct TypedConstruction {
  std::string name;              ///< "arcs", "ellipses", ...; empty: none
  std::optional<long> fixation;  ///< order of parabolas, 1 or 2
  std::string prefer = "fair";   ///< tangents that are not given, "neighbours" among them
  std::vector<long> insert;      ///< segments from 1 that get a point
};

/// What they ask for; its `job` has `prefer` alone. Errors: E203 with the option's name.
[[nodiscard]] Result<RegionJob> construction_values(const TypedConstruction& typed);

/// The same with the job of the points, whose `prefer` does not count.
[[nodiscard]] RegionJob with_job(RegionJob construction, const FitJob& job);

/// An error of `region_table` or `fit_construction`; where given data contradict each other, with
/// what may be given instead.
[[nodiscard]] Error explained(const PointSeries& series, const RegionJob& job, const Error& error,
                              const RunContext& run);

}  // namespace obvid
