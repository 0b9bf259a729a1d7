// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Triangle over a chord in which every convex curve with the given data lies ([003], figure 2).
struct ConvexTriangle {
  Vec2 apex;               ///< where both sides meet
  double height = 0.0;     ///< distance of the apex from the chord, > 0 (H_i of the sources)
  double to_apex = 0.0;    ///< from the start of the chord to the apex
  double from_apex = 0.0;  ///< from the apex to the end of the chord
  int side = 0;            ///< +1 when the apex lies on the chord's left, -1 on its right
};

/// Triangle of the chord and the tangents at its ends (tangents of any length, pointing along the
/// curve). Nothing when the ends coincide, when the tangents are parallel, or when they do not meet
/// ahead of the start and behind the end: then no convex curve with these tangents turns by less
/// than half a turn.
[[nodiscard]] std::optional<ConvexTriangle> tangent_triangle(Vec2 start, Vec2 start_tangent,
                                                             Vec2 end, Vec2 end_tangent);

/// Triangle of the chord start-end and the lines of both neighbouring chords: what the points alone
/// say about a convex curve. Nothing under the same conditions.
[[nodiscard]] std::optional<ConvexTriangle> chord_triangle(Vec2 before, Vec2 start, Vec2 end,
                                                           Vec2 after);

}  // namespace obvid
