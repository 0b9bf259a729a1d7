// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <optional>

#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// Curvatures of two arcs that join two tangents.
struct BiarcCurvatures {
  double first = 0.0;
  double second = 0.0;
};

/// Curvature of the second arc when the first one is chosen: tangent to the first arc and to the
/// end tangent ([Kurnosenko 2013], Q = 0). Infinite first curvature gives the circle through the
/// start.
[[nodiscard]] double second_curvature(const ChordFrame& frame, double first);

/// Choice of [000]: the arcs pass, with whichever of them gets there, through the middle of the
/// piece that the region cuts out of the median of the triangle of chord and tangents. Both
/// curvatures stay between those of the frame, so they are monotone along a whole contour whose
/// segments share one curvature at each point. Where there is no such triangle (headings a right
/// angle or more from the chord, or an inflection inside) both arcs take the geometric middle of
/// their ranges instead. `direction` +1: signed curvature increases. Nothing when no spiral exists.
[[nodiscard]] std::optional<BiarcCurvatures> choose_biarc(const ChordFrame& frame, int direction);

/// The two arcs from start to end with these curvatures; each meets its neighbour with a common
/// tangent. An arc of zero curvature becomes a line.
[[nodiscard]] std::array<Piece, 2> biarc(const Element& start, const Element& end,
                                         const BiarcCurvatures& curvatures);

}  // namespace obvid
