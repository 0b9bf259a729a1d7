// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/geom/element.h"

namespace obvid {

/// Two elements seen from their chord, without any angle: unit tangents in the frame whose x axis
/// is the chord.
struct ChordFrame {
  double h = 0.0;      ///< chord
  Vec2 start_tangent;  ///< (cos alpha, sin alpha)
  Vec2 end_tangent;    ///< (cos beta, sin beta)
  double kappa_start = 0.0;
  double kappa_end = 0.0;
};

[[nodiscard]] ChordFrame chord_frame(const Element& start, const Element& end);
/// From tangent vectors of any length, for points of a curve.
[[nodiscard]] ChordFrame chord_frame(Vec2 start, Vec2 start_tangent, double kappa_start, Vec2 end,
                                     Vec2 end_tangent, double kappa_end);

/// Boundary of a region: two arcs that touch each other, the first from the start of the chord,
/// the second to its end.
struct Boundary {
  double kappa_first = 0.0;
  double kappa_second = 0.0;
  Vec2 joint_tangent;    ///< unit tangent where the arcs meet
  double highest = 0.0;  ///< largest ordinate over the chord, >= 0 (the chord's left is positive)
  double lowest = 0.0;   ///< smallest ordinate, <= 0
};

/// The region in which every spiral with the data of both elements lies ([000], section
/// "Forming the region"; [Kurnosenko 2013]), and its size.
struct SegmentRegion {
  Boundary from_start;  ///< osculating circle at the start, then the arc tangent to it and the end
  Boundary to_end;      ///< arc tangent to the start, then the osculating circle at the end
  double lower_height = 0.0;    ///< height above the chord of the boundary that is nearer to it
  double parallel_width = 0.0;  ///< between lines parallel to the chord that touch the boundaries
  double width = 0.0;  ///< bound of the distance between any two curves of the region: the larger
                       ///< of `parallel_width` and of the largest gap across the chord
};

/// The boundaries of a region at their place in the plane.
struct PlacedBoundaries {
  ChordFrame frame;
  SegmentRegion region;
  Vec2 start;  ///< of the chord
  Vec2 along;  ///< unit vector of the chord
};

/// Region of two elements of a spiral of this direction (+1 curvature increases). Nothing when no
/// such spiral exists ([Kurnosenko 2013]) beyond rounding. Infinite curvatures are allowed at
/// one end each: they stand for "unknown" and give the region of the tangents alone.
[[nodiscard]] std::optional<SegmentRegion> segment_region(const ChordFrame& frame, int direction);

/// Height difference of the two circle arcs over the chord that keep one end tangent each. Every
/// spiral with these tangents lies between them, whatever its curvatures (Kurnosenko's bilens):
/// the weaker bound where rounding hides the region.
[[nodiscard]] double bilens_width(const ChordFrame& frame);

/// Ordinate of a boundary over abscissa x of the chord's frame, 0 <= x <= h. Nothing when a heading
/// on it is a right angle or more from the chord, or a curvature is infinite.
[[nodiscard]] std::optional<double> boundary_ordinate(const ChordFrame& frame,
                                                      const Boundary& boundary, double x);

/// Whether a point, given relative to the start of the chord in the chord's frame, lies in the
/// region, with `slack` (units) on either side. Guaranteed for segments whose headings stay within
/// a right angle of the chord; elsewhere only the parallel lines are tested.
[[nodiscard]] bool contains(const SegmentRegion& region, const ChordFrame& frame, Vec2 local,
                            double slack);

}  // namespace obvid
