// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// One part of the contour between two neighbouring stations (docs/claims.md). NaN: not known.
struct SegmentReport {
  std::optional<std::size_t> from;  ///< point of the series at its start; files need not say it
  std::optional<std::size_t> to;    ///< and at its end
  double chord = 0.0;
  double points_only_error = 0.0;  ///< NaN on the first and last chord, and beside vertices
  double width = 0.0;              ///< largest width of the region after refinement
  double width_unrefined = 0.0;    ///< between its stations (and vertices) alone
  double deviation = 0.0;          ///< contour to the farther boundary of the unrefined region
  Vec2 deviation_at;               ///< point of the contour where that occurs
  std::size_t inserted = 0;        ///< elements that the bound needed inside this part
};

/// A given range at an end of which the contour lies: it would go on if it might.
struct ActiveRange {
  std::size_t point = 0;
  bool heading = true;  ///< else of the curvature
  bool high = false;    ///< at the greatest value, else at the least

  bool operator==(const ActiveRange&) const = default;
};

/// How well the contour keeps what the user fixed.
struct GivenReport {
  std::size_t headings = 0;  ///< how many were given
  std::size_t curvatures = 0;
  std::size_t corners = 0;
  double heading_miss = 0.0;          ///< largest, rad; of ranges: how far beyond an end
  double curvature_miss = 0.0;        ///< largest, of the given curvature; likewise
  std::size_t heading_ranges = 0;     ///< how many were given
  std::size_t curvature_ranges = 0;   ///< likewise
  std::vector<ActiveRange> active{};  ///< by points, the heading's first
};

/// How the headings and curvatures were found.
struct ChainReport {
  int newton_steps = 0;
  double smallest_margin = 0.0;   ///< smallest relative distance of a segment from its cone, > 0
  std::size_t free_elements = 0;  ///< joints inserted between points where one piece cannot do
  std::optional<double> slope_step_g2;  ///< of a G3 contour: the largest step of the slope of
                                        ///< curvature that the G2 contour has, of the largest slope
                                        ///< at the ends of both pieces
  std::string g2_because{};  ///< why a contour is G2 throughout that was to be G3; not stored
  std::optional<double> waviness_g2;  ///< of a G3 contour: the waviness that the G2 contour has;
                                      ///< nothing where it has none
};

/// Figures about the whole contour, as they stand in the contour file.
struct FitReport {
  std::vector<SegmentReport> segments;
  double tolerance = 0.0;
  double largest_width = 0.0;
  double largest_deviation = 0.0;  ///< of all parts; NaN where none is known
  double largest_move = 0.0;       ///< how far a point was moved; 0 when interpolated exactly
  std::vector<double> moves;       ///< per point, an upper bound of its distance from the contour,
                                   ///< units; empty when interpolated exactly
  int vertices = 0;
  int vertices_lower_bound = 0;
  int inflections = 0;
  std::size_t inserted_points = 0;
  std::optional<double> waviness;  ///< hills of the slope of curvature on a run (docs/claims.md);
                                   ///< nothing for lines and arcs, and where rounding hides it
  GivenReport given;
  std::optional<double>
      carrier_deviation;  ///< largest distance from the spirals as measured, units;
                          ///< nothing for the spirals, and where there are none
  std::optional<double> outside_spirals_region;  ///< largest distance from the regions of the
                                                 ///< spirals as measured, units; likewise
  double seconds = 0.0;  ///< of forming, proving and measuring, on the clock
  double comparing_seconds =
      0.0;  ///< of these for what is measured against the spirals; not stored
  ChainReport chain;
};

}  // namespace obvid
