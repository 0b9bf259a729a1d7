// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include "obvid/exchange/drawing.h"
#include "obvid/geom/vec3.h"
#include "obvid/series/point_series.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

/// Line across which an input is mirrored, through the origin.
enum class Mirror {
  kNone,
  kX,  ///< the x axis: y changes its sign
  kY,  ///< the y axis: x changes its sign
};

/// What becomes of the coordinates of an input before anything else looks at them, in this order:
/// mirrored, scaled, turned about the origin, moved. What the input fixes goes along: headings,
/// curvatures, their ranges, tolerances, and pieces that are drawn. Names of units stay.
struct Placement {
  Mirror mirror = Mirror::kNone;
  double scale = 1.0;  ///< positive
  double turn = 0.0;   ///< rad, counter-clockwise; quarter turns are exact
  Vec3 move{};         ///< units of what was scaled

  [[nodiscard]] bool changes_nothing() const {
    return mirror == Mirror::kNone && scale == 1.0 && turn == 0.0 && move == Vec3{};
  }
};

/// The rounding of printed digits becomes an ellipse along the axes inside the turned one: the
/// same but for its axes after quarter turns, the circle of its smaller axis after others.
void place(const Placement& placement, PointSeries& series);
/// Heights are scaled and moved.
void place(const Placement& placement, SpaceSeries& series);
void place(const Placement& placement, Drawing& drawing);
/// What is fixed at a point, of a series or beside one.
void place(const Placement& placement, FixedData& fixed);

}  // namespace obvid
