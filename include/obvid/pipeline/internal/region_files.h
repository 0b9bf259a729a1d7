// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/internal/data_table.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/internal/sketch.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/region_table.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Number of a point as tables print it: 9, and 9.1, 9.2 for those inserted behind it.
[[nodiscard]] std::string region_point_name(const RegionPoint& point);
/// "9-10", "9.1-10".
[[nodiscard]] std::string region_segment_name(const RegionPart& part, const RegionRow& row);

/// Headings of a point in degrees, by the turn in which its own lies between -180 and 180, so that
/// its range can be compared with it.
struct HeadingDegrees {
  explicit HeadingDegrees(double heading) : shift(principal_angle(heading) - heading) {}
  double operator()(double angle) const { return (angle + shift) / kOneDegree; }
  double shift;
};

/// The signed curvatures of a range whose radii are its least and its greatest one; 0 where the
/// range has a line, whose radius has no bound.
struct ExtremeRadii {
  double least, greatest;
};
[[nodiscard]] ExtremeRadii extreme_radii(const CurvatureRange& range);

/// How the heading of a point came: "given", "chosen, radius given, OUTSIDE its range", ...
[[nodiscard]] std::string heading_came_by(const RegionPoint& point);
/// What the columns of the tables mean.
[[nodiscard]] std::vector<std::string> region_legend(const RegionTable& table);
/// What is told of a part as a whole: its largest width, where that is unknown, what "*" means
/// where a range of headings has it.
[[nodiscard]] FigureRows region_figures(const RegionPart& part, const Units& units);

/// One row per point with the segment that begins there, lengths in units, angles in degrees, all
/// digits; an empty cell where nothing is known. Inserted points follow in a second series, whose
/// rows say `inserted`.
[[nodiscard]] DataTable region_rows(const RegionTable& table);

/// The construction's own table, one row per segment; empty without one.
[[nodiscard]] DataTable construction_rows(const RegionTable& table);

/// The same as LaTeX tables (points, segments, the construction) for each series: plain `tabular`,
/// four decimals of a length of millimetre size, as the papers print them.
[[nodiscard]] std::string region_latex(const PointSeries& series, const RegionTable& table);

/// Drawing of the worksheet: points with numbers, tangents, triangles, arcs of the adjacent
/// circles, the limiting arc chains, and the region magnified across its chords.
struct RegionDrawing {
  Sketch sketch;
  double magnified =
      1.0;  ///< how many times wider the region is drawn; a power of 10, 2 or 5 times
};
[[nodiscard]] RegionDrawing region_drawing(const PointSeries& series, const RegionTable& table);

/// The worksheet in a format, and what is to be said about it ("... 200 times wider ...", or
/// nothing).
struct RegionFile {
  std::string text;
  std::string remark;
};

/// `ending`: of the file, without its dot: "csv" (with a construction its own table), "tex", "json"
/// (tables), "svg", "dxf" (drawings), "html" (page with both, which says what was `asked`);
/// capitals do not matter. Errors: E202, another one; E103.
[[nodiscard]] Result<RegionFile> region_file(const std::string& ending, const PointSeries& series,
                                             const RegionTable& table, const RunContext& run = {},
                                             const std::string& asked = {});

}  // namespace obvid
