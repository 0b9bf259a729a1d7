// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/geom/vec3.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {

/// What a body leaves open below the water where no vertical plane closes it.
struct Openings {
  double volume = 0.0;  ///< units^3: about, between the borders and what may close them level
  double width = 0.0;   ///< units: the largest level distance between them, across the border
  Vec3 at;              ///< where that is
};

/// Borders of one patch alone, below the water. Each is closed level: to y = 0 (`half`), else to
/// the plane of constant y that is nearest to the connected borders by what lies between, or to
/// another border where that is nearer. What a lid of level lines leaves of the integral of
/// z - water is the integral of the distance, the depth and dx; it is nothing where a border lies
/// in a plane of constant y (a centre plane) or of constant x (an upright transom), or in one
/// vertical plane with all borders that it is connected with.
///
/// Measured at places of each span, not bounded. O(places x borders). Error: E103.
[[nodiscard]] Result<Openings> openings_below(const Topology& topology, double water, double size,
                                              bool half, const RunContext& run);

}  // namespace obvid
