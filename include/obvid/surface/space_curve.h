// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/nurbs.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// NURBS curve in space: `points.size() + degree + 1` knots, ascending, clamped (the first and the
/// last `degree + 1` equal); `weights` one per point, all positive, or empty when all are 1.
struct SpaceCurve {
  int degree = 0;
  std::vector<double> knots;
  std::vector<Vec3> points;
  std::vector<double> weights;

  friend bool operator==(const SpaceCurve&, const SpaceCurve&) = default;
};

/// A closed range of a parameter.
struct Range {
  double from = 0.0;
  double to = 1.0;

  [[nodiscard]] double length() const { return to - from; }
  [[nodiscard]] double at(double part) const {  ///< part 0: from, 1: to, exactly
    return part >= 1.0 ? to : from + part * (to - from);
  }
};

/// Point and derivatives by the native parameter.
struct SpaceJet {
  Vec3 point;
  Vec3 d1;
  Vec3 d2;
  Vec3 d3;
};

/// Why the curve breaks the rules above, as an error: E203 numbers that do not belong together,
/// knots that descend, are not clamped or have a multiplicity above the degree (+ 1 at the ends), weights
/// <= 0, degree outside 1..kMaxSurfaceDegree; E303 what is not finite.
[[nodiscard]] Result<void> check(const SpaceCurve& curve);

/// Largest degree of curves and surfaces in space.
inline constexpr int kMaxSurfaceDegree = 9;

[[nodiscard]] Range domain(const SpaceCurve& curve);
/// Point and derivatives; outside the domain the end span goes on. O(degree^2 + log n).
[[nodiscard]] SpaceJet evaluate(const SpaceCurve& curve, double u);

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

// Operations that leave the shape as it is.
[[nodiscard]] SpaceCurve reversed(const SpaceCurve& curve);
/// Knots scaled and moved onto the range.
[[nodiscard]] SpaceCurve with_domain(const SpaceCurve& curve, Range range);
/// `new_knots` ascending, inside the domain; each may repeat. Boehm, Oslo form. O(n + new).
[[nodiscard]] SpaceCurve with_knots(const SpaceCurve& curve, const std::vector<double>& new_knots);
/// Degree raised to `degree` (not lowered); every inner knot gains the same multiplicity.
[[nodiscard]] SpaceCurve with_degree(const SpaceCurve& curve, int degree);
/// The parts before and after u, strictly inside the domain; u stays the knot between them.
[[nodiscard]] std::array<SpaceCurve, 2> split(const SpaceCurve& curve, double u);
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
