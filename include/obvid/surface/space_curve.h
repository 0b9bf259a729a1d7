// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/nurbs.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Curvature of a space curve, >= 0, 1/unit; 0 where the curve stands still.
[[nodiscard]] double curvature(const SpaceJet& jet);

// Curves of known shape.
[[nodiscard]] SpaceCurve line_between(Vec3 from, Vec3 to);
/// Arc of a circle from `start` around the axis through `centre` with unit direction `axis`, by
/// `angle` rad (sign: right-hand rule), |angle| <= 2 pi: rational quadratic, exact, one span for
/// each begun quarter turn... knots run from 0 to 1.
[[nodiscard]] SpaceCurve arc_about(Vec3 start, Vec3 centre, Vec3 axis, double angle);
/// A plane curve in its plane.
[[nodiscard]] SpaceCurve placed(const NurbsCurve& curve, const Frame& frame);

/// All on [0, 1], of one degree, with the same knots, ready to be the rows of a surface. Knots that
/// differ by less than `kSameKnot` of the domain are made one.
[[nodiscard]] std::vector<SpaceCurve> compatible(std::vector<SpaceCurve> curves);
inline constexpr double kSameKnot = 1e-12;

/// C2 cubic through the points at the parameters (ascending, as many as points, at least 2): third
/// derivatives continuous at the second and last but one (not-a-knot); of 2 points a line, of 3 a
/// parabola. Errors: E304, E313 parameters not ascending.
[[nodiscard]] Result<SpaceCurve> interpolated(const std::vector<Vec3>& points,
                                              const std::vector<double>& parameters);
/// Accumulated chord lengths to the power `exponent` (1: chord length, 1/2: centripetal), scaled
/// to [0, 1]. Equal neighbours give equal parameters.
[[nodiscard]] std::vector<double> chord_parameters(const std::vector<Vec3>& points,
                                                   double exponent = 1.0);

}  // namespace obvid
