// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fewest_pieces.h"
#include "obvid/geom/vec2.h"

namespace obvid::alignment {

/// Joints of the chords of points on a map with each corner rounded by an arc that passes its point
/// within the tolerance: many elements. There may be none (a chord that goes straight back, the
/// seam of a loop).
[[nodiscard]] std::vector<Node> rounded_corners(const std::vector<Vec2>& points,
                                                const std::vector<double>& tolerance);

/// The same around a loop, whose last point is the first one again: from the middle of the first
/// chord once around to it, so that the corner where the points begin is rounded as the others are.
[[nodiscard]] std::vector<Node> rounded_corners_around(const std::vector<Vec2>& points,
                                                       const std::vector<double>& tolerance);

/// Joints of few grades over ascending stations that meet at heights, within their tolerances, each
/// such corner rounded by a parabola, or an arc where `arcs`, that passes the heights within them.
/// No grade is one that heights do not bear: between two heights it is that of a chord of theirs,
/// each end moved by its tolerance. There always are such. With `lap` around a loop, whose last
/// height is the first one again: from the middle of the first grade once around to it.
[[nodiscard]] std::vector<Node> rounded_grades(const std::vector<Vec2>& heights,
                                               const std::vector<double>& tolerance, bool arcs,
                                               double lap);

}  // namespace obvid::alignment
