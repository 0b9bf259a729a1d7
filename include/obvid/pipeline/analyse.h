// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"
#include "obvid/pipeline/audit.h"
#include "obvid/series/analysis.h"

namespace obvid {

/// A series of points with what the points alone say.
struct AnalysedSeries {
  PointSeries series;
  Analysis analysis;
};

/// A drawing with what a curvature comb would show of each of its curves, and with what the points
/// say of the series that was asked for.
struct AnalysedDrawing {
  Drawing drawing;
  std::vector<CurveAudit> audits;
  std::optional<AnalysedSeries> points;
};

/// `curve` counts from 0, curves before series; without it the longest. `where` stands in errors.
/// Errors: E203 when there is no such curve.
[[nodiscard]] Result<AnalysedDrawing> analyse_drawing(Drawing drawing,
                                                      const std::optional<std::size_t>& curve,
                                                      const std::string& where);

/// Says where the rounding of the coordinates decides which way the curvature changes.
void add_rounding_warning(PointSeries& series, const Analysis& analysis);

/// Figures of a series that nobody fitted yet.
struct SeriesFigures {
  const char* kind = "";  ///< points, route, single points, waypoints
  double length = 0.0;    ///< of its edges, units
  bool closed = false;    ///< the last point is the first one again
  Vec2 box;               ///< width and height, units
};

[[nodiscard]] SeriesFigures figures_of(const PointSeries& series);

}  // namespace obvid
