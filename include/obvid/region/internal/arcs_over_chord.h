// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// sin^2 of half the turn between the end tangents, without cancellation.
[[nodiscard]] double half_turn_sine_squared(const ChordFrame& frame);

/// Unit tangent where two arcs with these curvatures meet that keep the end tangents of a chord, by
/// closing the chord ([Kurnosenko 2013]). An infinite curvature stands for an arc that is a point.
[[nodiscard]] Vec2 joint_tangent(const ChordFrame& frame, double first, double second);

/// Abscissa of that joint, 0 to h, for arcs within a right angle of the chord.
[[nodiscard]] double joint_abscissa(const ChordFrame& frame, double first, double second,
                                    Vec2 tangent);

/// Where the median from the middle of the chord (0) to the apex of the end tangents (1, relative
/// to the start of the chord in its frame) meets a boundary. Nothing when a heading on the boundary
/// is a right angle or more from the chord. Of a boundary with a circle of radius 0 the other arc
/// counts alone, as in `ordinate_over_chord`.
[[nodiscard]] std::optional<double> part_of_median(const ChordFrame& frame,
                                                   const Boundary& boundary, Vec2 apex);

}  // namespace obvid
