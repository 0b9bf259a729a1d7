// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fit/prepare.h"
#include "fit/shape.h"

namespace obvid::pipeline_detail {

/// Puts corners where two lines or arcs meet between the last measured point of one and the first
/// of the next, and takes those away that were found at these points where they lie farther from
/// there than their tolerances (docs/methods/fairing.md, "Corners between points"). `angle`: the
/// least turn of a corner, rad.
void add_corners_between(Prepared& series, double angle);

/// Two measured points with how far each may be off.
struct PointsBeside {
  Vec2 before, after;
  double reach_before = 0.0, reach_after = 0.0;
};

/// Whether the contour along `a` as far as `corner` and from there along `b` has both points within
/// their reaches, and neither on the other side of the corner.
[[nodiscard]] bool lies_between(const Shape& a, const Shape& b, const PointsBeside& points,
                                Vec2 corner);

}  // namespace obvid::pipeline_detail
