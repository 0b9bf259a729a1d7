// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// A NURBS curve: `points.size() + degree + 1` knots, one weight per point.
struct NurbsCurve {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec2> points;
  std::vector<double> weights;

  friend bool operator==(const NurbsCurve&, const NurbsCurve&) = default;
};

/// The whole contour as one NURBS curve with exactly the points of its pieces: piece i over the
/// knot span [i, i + 1], inner knots of multiplicity `degree`. Geometrically as continuous as the
/// contour, corners included; its parameter runs at another speed in every piece. A closed contour
/// gives a curve whose last point is its first, with clamped knots and not periodic ones.
///
/// Nothing unless every piece is a rational Bezier of one degree with end weights 1, control points
/// given as plain coordinates, and each piece starts exactly where the one before ends (on a closed
/// contour, the first where the last ends).
[[nodiscard]] std::optional<NurbsCurve> as_one_nurbs(const Contour& contour);

}  // namespace obvid
