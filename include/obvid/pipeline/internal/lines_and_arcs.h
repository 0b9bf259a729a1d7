// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {

/// A line or circle arc of a contour of spirals that several points lie on.
struct LineOrArc {
  std::size_t from = 0, to = 0;  ///< its first and last point; around the start of a closed contour
                                 ///< `to` is the smaller one
  double kappa = 0.0;            ///< signed curvature, 1/unit; 0: a line
  Vec2 centre;                   ///< of an arc; not of a line
  double theta = 0.0;            ///< heading of a line at its start, rad
  double length = 0.0;  ///< units, with what lies ahead of its first point and behind its last
  double off = 0.0;     ///< largest distance of those points from its line or circle, units

  /// `theta` in degrees, in [-180, 180].
  [[nodiscard]] double heading_deg() const { return principal_degrees(theta); }
};

/// Those of at least four points, in order; pieces taken over from a drawing are not among them.
/// Nothing where the carrier is not that of spirals: arcs of other carriers mean nothing alone.
[[nodiscard]] std::vector<LineOrArc> lines_and_arcs(const Contour& contour);

}  // namespace obvid
