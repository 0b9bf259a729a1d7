// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/vec2.h"

namespace obvid::fairing_detail {

/// Points in order with their tolerances and the curvature of a smooth curve along them.
struct SmoothPoints {
  std::vector<Vec2> points;
  std::vector<double> reach;
  std::vector<double> at;     ///< arc length
  std::vector<double> kappa;  ///< of the smooth curve
  std::vector<bool> free;     ///< nothing is given at the point
  bool closed = false;        ///< the last point is followed by the first
  /// Of the tolerance: how far a transition keeps two primitives apart that touch each other.
  double shift = 0.2;
};

/// Points first .. last that mean one circle or line.
struct Primitive {
  std::size_t first = 0, last = 0;
  Vec2 anchor;           ///< a point of it, near the middle
  double theta = 0.0;    ///< heading at the anchor
  double kappa = 0.0;    ///< 0: a line
  double before = 0.0;   ///< arc length from the first point's foot to the anchor
  double after = 0.0;    ///< and from the anchor to the last one's
  double lead = 0.0;     ///< of `before`, how much lies ahead of the first point's foot
  double trail = 0.0;    ///< of `after`, how much lies behind the last one's
  double quality = 0.0;  ///< change of curvature beside it over the one that the tolerance hides
  bool joined = false;   ///< the next one touches it: between them is a transition alone
  double share = 1.0;    ///< of the tolerance that its fit may use up
};

/// Stretches that fit one circle or line with half their tolerance to spare and that are far longer
/// than a stretch of a spiral could be that fits as well (docs/methods/fairing.md). In order,
/// without common points. Cost O(n) fits.
[[nodiscard]] std::vector<Primitive> find_primitives(const SmoothPoints& series, Watch& watch);

/// Primitives of which points, anchor, heading and curvature are known nearly: with least squares,
/// without points at their ends that are not free, and cut where neighbours touch. Those that
/// nothing is left of are left out. `last` may count on over the seam of a closed series.
[[nodiscard]] std::vector<Primitive> fitted_primitives(const SmoothPoints& series,
                                                       std::vector<Primitive> known, Watch& watch);

}  // namespace obvid::fairing_detail
