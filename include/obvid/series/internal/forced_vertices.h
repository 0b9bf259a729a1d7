// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Vertices that the points force: how often the curvature of every curve of the class below
/// changes its direction (jumps of the curvature count as rises and falls).
///
/// The class: the heading is continuous and the curvature rises and falls finitely often; the curve
/// passes the points in their order, each within its reach; and between the first and the last
/// point of every four that are compared its headings keep within a right angle, or it bends one
/// way and they keep within a half turn. Four points are compared only where the points between
/// them, as far as their reaches say, can be passed in order within a right angle.
///
/// Exact for that class: changes of sign of a sequence of "is the fourth point left of the circle
/// through the three before it" grow when points of the curve are put between, and in the limit
/// they are those of the curvature's rate (docs/methods/series.md, "Forced vertices"). A sign
/// counts when no move of the four points within their reaches changes it.
///
/// `reach` holds the tolerance of each point, or is empty: points as exact as their coordinates.
/// A closed series does not repeat its first point; its bound is even. At least one point, no two
/// neighbours equal. O(n) time; for exact points few, otherwise some 300 comparisons per point.
[[nodiscard]] int forced_vertices(const std::vector<Vec2>& points, const std::vector<double>& reach,
                                  bool closed);
/// The same as part of some longer work; when that is cancelled, it is no bound.
[[nodiscard]] int forced_vertices(const std::vector<Vec2>& points, const std::vector<double>& reach,
                                  bool closed, Watch& watch);

}  // namespace obvid
