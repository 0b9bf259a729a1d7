// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/exchange/drawing.h"
#include "obvid/io/read_points.h"
#include "obvid/mesh/plane_row.h"
#include "obvid/pipeline/placement.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// Whether a file is a drawing of another system (STEP, IGES, BREP, ...), a mesh or a stored
/// contour, by its first bytes. False for lists of points and for files that cannot be opened.
[[nodiscard]] bool is_drawing(const std::string& path);

/// Curves and series of points of a drawing, the curve of a stored contour, or the sections of a
/// mesh (STL, PLY, OBJ) with planes: each chain of edges a series in the coordinates of its plane.
/// Errors: those of the formats; E203 planes for what is no mesh; E311 a mesh that none of them
/// meets, or without planes; E103.
[[nodiscard]] Result<Drawing> read_drawing(const std::string& path,
                                           const std::vector<PlaneRow>& planes = {},
                                           const RunContext& run = {});

/// The same for a text in memory; `name` stands in errors, and its ending tells OBJ. STEP, IGES and
/// BREP go through a file in the system's folder for such (PrivateCopy).
[[nodiscard]] bool is_drawing_text(std::string_view text, std::string_view name = {});
[[nodiscard]] Result<Drawing> parse_drawing(const std::string& text, const std::string& name,
                                            const std::vector<PlaneRow>& planes = {},
                                            const RunContext& run = {});
[[nodiscard]] bool needs_cad(std::string_view text);

/// Which curve or series of points of a drawing is meant.
struct CurveChoice {
  std::optional<std::size_t> number;  ///< from 0, curves before series
  std::string name;  ///< in place of the number: the label, or a word of one label alone
  bool all = false;  ///< each of them by itself
  std::vector<std::string> several{};  ///< numbers from 1 and names, where several are asked for

  /// Whether one of them, or several, are asked for.
  [[nodiscard]] bool asked() const {
    return number.has_value() || !name.empty() || !several.empty();
  }
};

/// Numbers of the curves that are asked for, ascending: one for a number, all of a name or of a
/// layer, else the one with a word of its name alone. Errors: E203 where there is none.
[[nodiscard]] Result<std::vector<std::size_t>> chosen_curves(const Drawing& drawing,
                                                             const CurveChoice& asked,
                                                             const std::string& path);

/// Number of the curve that is taken: the asked one, else the longest of curves, tracks and
/// polylines, else of routes, else of points drawn one by one; curves come before series. Waypoints
/// are taken only when they are asked for. Errors: E203 when there is no such curve, or several of
/// the name; E311 when there is none at all.
[[nodiscard]] Result<std::size_t> chosen_curve(const Drawing& drawing, const CurveChoice& asked,
                                               const std::string& path);

/// "curve 2 of 5 was taken, track Foo, the longest of its kind; ...": for the user.
[[nodiscard]] std::string chosen_text(const Drawing& drawing, std::size_t chosen, bool asked);

/// Whether one of several curves was taken that nobody asked for, which is a warning; else it is a
/// remark which one it is.
[[nodiscard]] bool is_guessed(const Drawing& drawing, const CurveChoice& asked);

/// The edges between the points of a polyline as a curve of lines.
[[nodiscard]] DrawnCurve edges_of(const PointSeries& series);

/// What becomes of the pieces of a drawing (docs/methods/drawings.md).
enum class DrawnUse {
  kAutomatic,  ///< lines, arcs, arcs of ellipses and clothoids stay as they are; lines that are
               ///< chords of a curve, and splines, become points
  kExact,      ///< every line stays, however many there are
  kPoints,     ///< everything becomes points
};

/// How a curve of a drawing becomes a series of points.
struct ImportOptions {
  CurveChoice curve;               ///< default the longest
  std::vector<PlaneRow> planes{};  ///< where meshes are cut
  DrawnUse use = DrawnUse::kAutomatic;
  std::optional<double>
      tolerance;            ///< largest distance of a chord from its curve [1e-4 of the size]
  PointListOptions list{};  ///< of lists of points
  Placement placement{};    ///< of whatever is read
  std::optional<Units> units{};  ///< that the user states: of all that is told, too
  bool unordered = false;   ///< points are put in the order of their curve, which a warning tells
  bool drop_outliers = false;  ///< then points off the curve of their neighbours are left out,
                               ///< which a warning names
};

/// The same options with the unit that the user states, if any.
[[nodiscard]] inline ImportOptions in_units(ImportOptions options,
                                            const std::optional<Units>& units) {
  if (units) options.units = units;
  return options;
}

/// Points to fit: of a text file as they are, of a drawing its longest series or curve, sampled.
/// Warnings say what was chosen. Errors: those of the formats; E203 when there is no such curve.
[[nodiscard]] Result<PointSeries> read_series(const std::string& path,
                                              const ImportOptions& options = {},
                                              const RunContext& run = {});
[[nodiscard]] Result<PointSeries> parse_series(const std::string& text, const std::string& name,
                                               const ImportOptions& options = {},
                                               const RunContext& run = {});

/// What a drawing or a contour file says of an alignment beside its curve, placed as its points.
struct DrawnRoad {
  std::optional<double> station{};           ///< of the start, units
  double length = 0.0;                       ///< of what is drawn, units
  std::optional<VerticalProfile> profile{};  ///< heights over its stations
};
struct RoadSeries {
  PointSeries points;
  DrawnRoad road;  ///< nothing of lists of points, nor where points were put in order or left out
};

/// As `read_series` and `parse_series`, with what is said of an alignment there; contour files are
/// curves as those of drawings are.
[[nodiscard]] Result<RoadSeries> read_road(const std::string& path, const ImportOptions& options,
                                           const RunContext& run = {});
[[nodiscard]] Result<RoadSeries> parse_road(const std::string& text, const std::string& name,
                                            const ImportOptions& options,
                                            const RunContext& run = {});

/// The points of a text that is a list of them, never a drawing, moved as `options` say.
[[nodiscard]] Result<PointSeries> parse_point_list(const std::string& text, const std::string& name,
                                                   const ImportOptions& options = {});

}  // namespace obvid
