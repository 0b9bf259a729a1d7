// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

/// An extremum of the curvature along a curve in space.
struct SpaceExtremum {
  double parameter = 0.0;
  Vec3 point;
  double curvature = 0.0;  ///< 1/unit
};

/// What the curvature of a curve in space is like: looked for at places, not proved.
struct SpaceAudit {
  std::vector<SpaceExtremum> vertices;  ///< between its ends
  std::size_t joints = 0;               ///< knots between its spans
  std::size_t steps = 0;                ///< of them: not G2, as `joint_limit` says
  double largest_turn = 0.0;            ///< at a joint, rad
  double largest_step = 0.0;            ///< of the curvature at a joint, of the largest anywhere
  double largest_curvature = 0.0;       ///< 1/unit
};

/// Evaluates the curve at 64 equal steps of each span, both sides of its knots by themselves;
/// swings below 1e-9 of the largest curvature are rounding; an extremum is narrowed down between
/// its neighbours. Errors: those of `check`; E103.
[[nodiscard]] Result<SpaceAudit> audit_in_space(const SpaceCurve& curve,
                                                const RunContext& run = {});
/// docs/schema/space_audit.schema.json
[[nodiscard]] std::string space_audit_json(const SpaceAudit& found);

}  // namespace obvid
