// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

// Both ways to make one curve of a contour without clothoids, for `nurbs_of`.

/// The whole contour as one NURBS curve whose homogeneous form is C1 at every joint but corners:
/// inner knots of multiplicity degree - 1 (degree at corners, and where neighbours turn by more
/// than 1e-6 rad), so that CAD kernels keep it as one edge. The curve is that of the pieces, apart
/// from rounding; its parameter runs at one speed on both sides of a joint. Continuous curvature of
/// the contour stays continuous curvature.
///
/// Pieces with weights are multiplied by a quadratic factor that makes the weight stand still at
/// both ends (docs/methods/curve.md): quartic spirals become degree 6, conics and arcs degree 4,
/// one more where the speed would otherwise change by more than 20 along the curve (not where a
/// piece ends with next to no speed of its own: cutting does not help it); all are raised to the
/// largest degree. Weights lie within [0.1, 10]: pieces are cut where they do not. A closed
/// contour gives a clamped curve that ends in its first point.
///
/// Errors: E311 no pieces; E310 clothoids, which are no NURBS curves, and rational pieces of degree
/// 6 and more (`index`: the piece); E501 where cutting does not bring the weights into their range
/// (weights of both signs), and where a piece is too short beside the others for a knot of its own.
/// Cost O(pieces). Under watch also E103.
[[nodiscard]] Result<NurbsCurve> joined_nurbs(const Contour& contour, Watch* watch = nullptr);

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
