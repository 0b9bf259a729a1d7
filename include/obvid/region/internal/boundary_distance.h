// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"
#include "obvid/region/internal/convex_triangle.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// Distance of a point, given relative to the start of the chord in the chord's frame, to the
/// nearest point of a boundary. A circle of radius 0 (infinite curvature) is its point.
[[nodiscard]] double boundary_distance(const ChordFrame& frame, const Boundary& boundary,
                                       Vec2 local);

/// `boundary_ordinate` for any boundary of a region: a circle of radius 0 leaves the other arc
/// alone, as the circle over the whole chord that keeps its tangent.
[[nodiscard]] std::optional<double> ordinate_over_chord(const ChordFrame& frame,
                                                        const Boundary& boundary, double x);

/// The arcs, or lines, of a boundary in the chord's frame, one or two from the start of the chord
/// to its end; of a circle of radius 0 there is none. They may turn by nearly a whole turn.
[[nodiscard]] std::vector<Piece> boundary_arcs(const ChordFrame& frame, const Boundary& boundary);

/// How a piece of a contour lies with respect to the region of the segment that it carries.
struct RegionPlacement {
  double farther = 0.0;  ///< largest distance to the farther of the two boundaries (f of [003])
  double outside = 0.0;  ///< largest distance from the region; 0 when it stays inside
  Vec2 farther_at;       ///< where the former is taken
  Vec2 outside_at;       ///< where the latter is taken
};

/// Distances of a curve from both boundaries of the region of two elements of a spiral of this
/// direction, sampled at `samples` parameters and refined around the largest: exact for the curves
/// between two points of a series, not proved. "Outside" is told by the ordinate over the chord, so
/// it needs headings within a right angle of the chord; elsewhere it stays 0. Nothing when there is
/// no such region.
[[nodiscard]] std::optional<RegionPlacement> place_in_region(const Piece& piece,
                                                             const Element& start,
                                                             const Element& end, int direction,
                                                             int samples = 64);

/// How far a convex contour and a monotone one can be apart on one segment ([003]; [Kurnosenko
/// 2013]).
struct ConvexErrors {
  double upper_height = 0.0;  ///< a: farther boundary of the monotone curve above the chord
  double lower_height = 0.0;  ///< nearer boundary above the chord, between parallel lines
  double apex_height = 0.0;  ///< H (chords) or H^t (tangents): apex of the triangle above the chord
  double apex_gap = 0.0;     ///< H - h as [003] prints it: apex to the parallel line that touches
                             ///< the nearer boundary. No boundary point is closer to the apex
  double apex_distance =
      0.0;             ///< b or b': apex to the nearest point of that boundary, >= `apex_gap`
  double bound = 0.0;  ///< larger of a and b: what convex and monotone curve can differ by
};

/// Errors of convex contours in `triangle` (of the tangents, or of the neighbouring chords) against
/// spirals of this direction with both elements; curvatures may be infinite or 0 as in
/// `segment_region`. Nothing when there is no such region.
[[nodiscard]] std::optional<ConvexErrors> convex_errors(const Element& start, const Element& end,
                                                        int direction,
                                                        const ConvexTriangle& triangle);

}  // namespace obvid
