// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface/surface.h"

namespace obvid::afloat {

/// Sides of patches that lie on one side of the body: +1 or -1 each, and which part each belongs
/// to.
struct Turned {
  std::vector<double> sign;
  std::vector<std::size_t> part;
  std::size_t parts = 0, twisted = 0;
};

/// How patches of a model with trims meet.
struct TrimJoints {
  /// Loops of each patch, what is there to their left; the sides of one without trims.
  std::vector<std::vector<TrimLoop>> loops;
  Turned turned;
  /// What meets nothing, as edges of one patch of chords; nothing else is filled in.
  Topology open;
};

/// Boundaries are the same where they are within 1e-6 of the size and what their trims are known
/// within, and run along each other within 30 degrees: told at 16 places of each span. Where more
/// than two meet none of them tells which side is which. Errors: E103.
[[nodiscard]] Result<TrimJoints> trim_joints_of(const SurfaceModel& model,
                                                const RunContext& run = {});

}  // namespace obvid::afloat
