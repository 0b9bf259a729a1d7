// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "obvid/surface_builders/internal/check.h"

namespace obvid {

/// What lies along the borders of trimmed patches.
struct TrimJoints {
  std::vector<TrimJointReport> joints;     ///< in the order of the patches
  TrimmedBorders borders;                  ///< of all trimmed patches
  std::vector<std::array<bool, 4>> along;  ///< sides of untrimmed patches that run along trimmed
                                           ///< ones from end to end
};

/// Borders of trimmed patches beside all others, and of the others beside these, as far as they are
/// within `nearness` (units) of each other; sides that are one edge of `same` are a seam of their
/// face; `size`: of the model. Error: E103.
[[nodiscard]] Result<TrimJoints> trim_joints_of(const SurfaceModel& model, const Topology& same,
                                                double nearness, double size,
                                                const RunContext& run);

}  // namespace obvid
