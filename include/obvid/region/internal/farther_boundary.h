// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/curve/pieces.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {

/// Consecutive pieces, from the parameter t0 of the first to t1 of the last.
struct PieceSpan {
  std::span<const Piece> pieces;
  double t0 = 0.0;
  double t1 = 1.0;
};

/// The region of two elements at its place in the plane.
struct PlacedRegion {
  ChordFrame frame;
  SegmentRegion region;
  Vec2 start;  ///< of the chord
  Vec2 along;  ///< unit vector of the chord
};

/// How far a curve gets from the farther of the two boundaries of its region, and where.
struct FartherBoundary {
  double distance = 0.0;
  Vec2 at;
};

/// Largest distance of a monotone curve from the farther boundary of the region of its own end
/// elements. No other monotone curve with these end elements gets farther from any point of it: the
/// other curve lies between the boundaries, and the way to one of them crosses it.
///
/// A circle meets a curve of monotone curvature three times at the most. So the distance from each
/// boundary rises to one top and falls from it, which is searched until the place is known to some
/// 1e-6 of a piece; 1e-5 of the distance and the rounding of a point are added. An upper bound for
/// curves that are monotone; not guaranteed for others. Coordinates should be near the curve: their
/// rounding is part of the bound. Cost: some forty evaluations, however many the pieces are.
[[nodiscard]] FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed);

}  // namespace obvid
