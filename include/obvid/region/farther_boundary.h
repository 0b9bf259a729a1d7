// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/curve/pieces.h"
#include "obvid/region/segment_region.h"

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
/// elements. No other monotone curve
/// with these end elements gets farther from any point of it: the other curve lies between the
/// boundaries, and the way to one of them crosses it.
///
/// An upper bound, at most 3e-4 of it and some roundings above the largest distance found. Steps of
/// the pieces are halved while what may lie between their ends exceeds that; it takes for granted
/// that the distance from a circle bends between three places at most twice as much as they tell.
/// Coordinates should be near the curve: their rounding is part of the bound. Cost: some seven
/// evaluations per piece, and forty for the largest.
[[nodiscard]] FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed);

}  // namespace obvid
