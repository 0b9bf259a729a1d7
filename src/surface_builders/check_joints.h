// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/surface_builders/internal/check.h"

namespace obvid {

/// All pairs of sides that meet within `nearness` (units), in the order of the patches; those that
/// `same` has as one edge are shared. Error: E103.
[[nodiscard]] Result<std::vector<JointReport>> joints_of(const SurfaceModel& model,
                                                         const Topology& same, double nearness,
                                                         const RunContext& run);

}  // namespace obvid
