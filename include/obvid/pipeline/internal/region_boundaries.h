// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// Headings (rad) and curvatures (of the largest) that differ by less at a joint are one.
[[nodiscard]] double joint_limit();

/// The arcs, or lines, of a boundary at its place in the plane; those shorter than coordinates tell
/// are left out.
[[nodiscard]] std::vector<Piece> boundary_in_plane(const PlacedBoundaries& placed,
                                                   const Boundary& boundary);

/// Both boundaries of a region, each from its first element to its second one.
struct RegionBoundaries {
  std::vector<Piece> from_start;  ///< the circle of the first element, then the arc that touches it
  std::vector<Piece> to_end;      ///< the arc that touches the circle of the second one, then that
};

/// The region of all curves of monotone curvature with these elements at their ends. Nothing where
/// there is no such curve.
[[nodiscard]] std::optional<RegionBoundaries> region_boundaries(const Element& start,
                                                                const Element& end);

}  // namespace obvid
