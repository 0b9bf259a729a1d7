// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/internal/bspline_cubic.h"
#include "obvid/curve/nurbs.h"

namespace obvid {

/// How far apart the knots of neighbouring points lie.
enum class SplineParameter {
  kChord,        ///< the chord: speed is nearly 1, what CAD systems do
  kCentripetal,  ///< its square root: less overshoot beside sharp turns and very uneven chords
};

/// What closes the equations of a C2 cubic spline.
enum class SplineEnd {
  kNatural,   ///< no second derivative at the ends: curvature 0
  kNotAKnot,  ///< the first two pieces are one cubic, and the last two
  kTangents,  ///< derivatives given at both ends
  kPeriodic,  ///< closed: the last point is followed by the first
};

/// Choices for `cubic_spline`.
struct CubicSplineOptions {
  SplineParameter parameter = SplineParameter::kChord;
  SplineEnd end = SplineEnd::kNotAKnot;
  Vec2 start_slope;  ///< for kTangents: derivative by the parameter; with kChord a unit vector
  Vec2 end_slope;    ///< likewise at the end
};

/// The C2 cubic spline through the points, one knot per point: what CAD systems draw, kept as the
/// baseline. It has no say in how its curvature changes (docs/methods/bsplines.md). A periodic
/// spline gets the first point once more at its end; give it only once. Cost O(n).
/// Two points give a line, three without tangents and not natural a parabola.
/// Errors: E304 fewer than two points (three when periodic); E313 neighbours that coincide; E203
/// a slope that is no number.
[[nodiscard]] Result<CubicSpline> cubic_spline(const std::vector<Vec2>& points,
                                               const CubicSplineOptions& options = {});

/// C2 cubic B-spline through the points with a given heading (rad) at each. That needs twice the
/// knots: 2n control points, 2n - 3 spans. Derivatives at the points are those of circles that turn
/// like the neighbouring segments; the curve may be neither convex nor monotone. Cost O(n).
/// Errors: E304 fewer than two points; E313 neighbours that coincide; E201 when headings and points
/// differ in number.
[[nodiscard]] Result<NurbsCurve> spline_through_tangents(
    const std::vector<Vec2>& points, const std::vector<double>& headings,
    SplineParameter parameter = SplineParameter::kChord);

}  // namespace obvid
