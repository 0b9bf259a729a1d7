// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Data that a designer fixes at one point, beyond its position.
struct FixedData {
  std::optional<double> theta;         ///< heading, rad
  std::optional<double> kappa;         ///< signed curvature, 1/unit
  std::optional<double> tolerance;     ///< how far the point may move, units
  std::optional<double> height{};      ///< of what stands above the plane, units; where it is read
  bool corner = false;                 ///< the contour may turn here at once (G0)
  std::optional<ValueRange> thetas{};  ///< headings that do, rad, at most half a turn apart
  std::optional<ValueRange> kappas{};  ///< signed curvatures that do, 1/unit

  bool operator==(const FixedData&) const = default;

  /// Whether a heading or a curvature is fixed, or its range.
  [[nodiscard]] bool says_how() const { return theta || kappa || thetas || kappas; }
};

/// A piece that a drawing has between two neighbouring points: it stays as it is.
struct KeptPiece {
  std::size_t from = 0;  ///< index of the point where it starts; it ends in the next one
  Piece piece;
};

/// Of points that a drawing has a spline drawn through, without telling the spline: a cubic one, by
/// the chords, without curvature at ends of which no direction is given; periodic where the last
/// point is the first one again.
struct ThroughPoints {
  std::string label;                   ///< of the spline: "SPLINE 2F on layer OUTLINE"
  std::optional<Vec2> start{}, end{};  ///< directions that it has there
};

/// What points of a drawing are, from those that a drawing is about to those that never are a curve
/// by themselves.
enum class SeriesKind {
  kLine,       ///< a polyline, a track, a list of points
  kRoute,      ///< a route of a GPX file: its corners, where a track is what was driven
  kLoose,      ///< points drawn one by one, in the order of the file
  kWaypoints,  ///< places of a GPX file
};

/// Points in the order in which they were read.
struct PointSeries {
  std::string name;   ///< title of the file, or its name
  std::string label;  ///< of the curve in its drawing; empty for lists of points
  std::string layer;  ///< of the drawing, where it has layers
  SeriesKind kind = SeriesKind::kLine;
  Units units;
  std::vector<Vec2> points;
  std::vector<FixedData> fixed;  ///< empty, or one entry per point
  std::vector<KeptPiece> kept;   ///< of drawings, ascending; empty for lists of points
  Vec2 rounding;  ///< half a unit of the last printed digit of x and of y; 0 when not from text
  double height_rounding = 0.0;           ///< the same of heights
  std::vector<std::string> warnings;      ///< sentences for the user, e.g. merged duplicates
  std::optional<ThroughPoints> spline{};  ///< what is drawn through them, where that is no polyline
  std::string id{};  ///< by what its drawing tells it from others: "rect7", where it does
};

/// The unit that the user states, with a warning when the file says otherwise.
inline void take_units(PointSeries& series, const Units& given) {
  if (auto told = take_units(series.units, given)) series.warnings.push_back(std::move(*told));
}

}  // namespace obvid
