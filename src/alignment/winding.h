// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "chain_of_elements.h"
#include "obvid/geom/vec2.h"

namespace obvid::alignment {

/// Headings that a curve runs through.
struct HeadingRange {
  double low = 0.0, high = 0.0;  ///< rad, unwrapped
};

/// The chord of an interval of points, and what a curve may do between them.
struct Passage {
  double heading = 0.0;  ///< of the chord, rad
  double most = 0.0;     ///< that a curve's heading may be away from it, rad
  bool any = false;      ///< the points are so near each other that any heading may be
};

/// Points in order, each known within its tolerance.
struct PointRow {
  const std::vector<Vec2>& points;
  const std::vector<double>& tolerance;
  bool closed = false;  ///< behind the last point comes the first one, `lap` on
  Vec2 lap{};
  const std::vector<Passage>* passages = nullptr;  ///< of its intervals, where they are known

  [[nodiscard]] std::size_t intervals() const { return points.size() - (closed ? 0 : 1); }
};

/// That between points i and i + 1. A curve goes nowhere back along the chord, and leaves it by no
/// more than the chords before and behind do (a quarter turn at the ends, where there are none) and
/// a twelfth of half a turn, but for what chords may be turned by as points move by their
/// tolerances.
[[nodiscard]] Passage passage_of(const PointRow& row, std::size_t i);

/// rad: what rounding makes of half a turn, which three points on half a circle may have.
inline constexpr double kRoundedTurn = 1e-9;
/// rad: what rounding makes of headings at feet that are found again: a place on the curve, known
/// to the digits of coordinates, times the curvature of what rounds a corner.
inline constexpr double kRefoundTurn = 1e-6;

/// Whether it allows these headings, with so much for rounding, rad. No curve turns by more than
/// half a turn there.
[[nodiscard]] bool allows(const Passage& passage, HeadingRange headings,
                          double rounded = kRoundedTurn);

/// Those of a clothoid from `s0` to `s1` of its length, which begins with heading `theta`.
[[nodiscard]] HeadingRange headings_along(double theta, double kappa0, double kappa1, double length,
                                          double s0, double s1);

/// Which intervals [i, i + 1], `first` <= i < `last`, the chain winds through between their feet:
/// it turns there as points do not show. None in a graph.
[[nodiscard]] std::vector<bool> wound_through(const Chain& chain, const PointRow& row,
                                              const std::vector<Foot>& feet, std::size_t first,
                                              std::size_t last, double rounded = kRoundedTurn);

/// Their number.
[[nodiscard]] std::size_t windings(const Chain& chain, const PointRow& row,
                                   const std::vector<Foot>& feet, std::size_t first,
                                   std::size_t last, double rounded = kRoundedTurn);

}  // namespace obvid::alignment
