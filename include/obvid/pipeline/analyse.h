// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/drawing.h"
#include "obvid/pipeline/audit.h"
#include "obvid/pipeline/import.h"
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
  std::optional<std::size_t> asked;  ///< number of the curve or series that was asked for
};

/// The curve that `options` ask for, else the longest; the drawing is placed as they say. `where`
/// stands in errors. Errors: E203 when there is no such curve; E103, asked for each piece.
[[nodiscard]] Result<AnalysedDrawing> analyse_drawing(Drawing drawing, const ImportOptions& options,
                                                      const std::string& where,
                                                      const RunContext& run = {});

/// Says where the rounding of the coordinates decides which way the curvature changes.
void add_rounding_warning(PointSeries& series, const Analysis& analysis);

/// Figures of a curve or a series of points that nobody fitted yet, as lists of them show.
struct DrawnFigures {
  std::string kind;        ///< "circle", "4 lines and 4 arcs", "spline", ...; of series points,
                           ///< route, single points, waypoints
  std::size_t pieces = 0;  ///< of a curve as it is drawn; what stands for a transition is one
  std::size_t points = 0;  ///< of a series; of a curve the ends of its pieces
  double length = 0.0;     ///< of a series that of its edges, units
  bool closed = false;     ///< it ends where it begins
  Vec2 low, high;          ///< corners of its box: of a curve, not of its control points
};

[[nodiscard]] DrawnFigures figures_of(const PointSeries& series);
[[nodiscard]] DrawnFigures figures_of(const CurveAudit& audit);

}  // namespace obvid
