// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

struct NurbsOptions {
  /// C1 in homogeneous form at every joint but corners, so that CAD kernels keep one edge: what CAD
  /// and DXF files hold. Else the pieces as they are, to the last bit: piece i over [i, i + 1],
  /// inner knots of multiplicity degree, the parameter at another speed in every piece.
  bool joined = true;
  /// Units, > 0: a contour with clothoids, which are no NURBS curves, is followed within it by a
  /// cubic, C2 but at corners. Nothing: such a contour is refused.
  std::optional<double> clothoid_tolerance{};
};

/// A contour as one NURBS curve.
struct ContourNurbs {
  NurbsCurve curve;
  double deviation = 0.0;  ///< units; 0: exact apart from rounding
};

/// The whole contour as one NURBS curve, geometrically as continuous as the contour, corners
/// included; a closed contour gives a clamped curve that ends in its first point. Joined curves
/// have weights in [0.1, 10]; how pieces with weights get there: docs/methods/curve.md.
///
/// Errors: E311 no pieces; E310 clothoids without a tolerance, rational pieces of degree 6 and more
/// (`index`: the piece), and what cannot be taken as it is when not joined: pieces that are not
/// rational Beziers of one degree with end weights 1 and plain coordinates, each beginning exactly
/// where the one before ends; E501 weights of both signs, or a piece too short beside the others
/// for a knot of its own; of clothoids those of `cubic_along`, E103 where `watch` ends it.
/// O(pieces). Reentrant.
[[nodiscard]] Result<ContourNurbs> nurbs_of(const Contour& contour,
                                            const NurbsOptions& options = {},
                                            Watch* watch = nullptr);

}  // namespace obvid
