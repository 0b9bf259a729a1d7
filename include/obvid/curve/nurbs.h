// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <type_traits>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/vec2.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Largest degree of NURBS curves and surfaces.
inline constexpr int kMaxNurbsDegree = 9;

/// NURBS curve in the plane (`Vec2`) or in space (`Vec3`): `points.size() + degree + 1` knots,
/// ascending, clamped (the first and the last `degree + 1` equal); `weights` one per point, all
/// positive, or empty when all are 1.
template <class V>
struct Nurbs {
  int degree = 0;
  std::vector<double> knots;
  std::vector<V> points;
  std::vector<double> weights;

  friend bool operator==(const Nurbs&, const Nurbs&) = default;
};
using NurbsCurve = Nurbs<Vec2>;
using SpaceCurve = Nurbs<Vec3>;

/// A closed range of a parameter.
struct Range {
  double from = 0.0;
  double to = 1.0;

  [[nodiscard]] double length() const { return to - from; }
  [[nodiscard]] double at(double part) const {  ///< part 0: from, 1: to, exactly
    return part >= 1.0 ? to : from + part * (to - from);
  }
};

/// Point and derivatives by the native parameter, in space.
struct SpaceJet {
  Vec3 point;
  Vec3 d1;
  Vec3 d2;
  Vec3 d3;
};
template <class V>
using NurbsJet = std::conditional_t<std::is_same_v<V, Vec2>, Jet, SpaceJet>;

// All of these are there for Vec2 and Vec3, and reentrant. Unless said otherwise they take curves
// that `check` accepts.

/// Why the curve breaks the rules above, as an error: E203 numbers that do not belong together,
/// knots that descend, are not clamped or have a multiplicity above the degree (+ 1 at the ends), weights
/// <= 0, degree outside 1..kMaxNurbsDegree; E303 what is not finite.
template <class V>
[[nodiscard]] Result<void> check(const Nurbs<V>& curve);

template <class V>
[[nodiscard]] Range domain(const Nurbs<V>& curve) {
  return {curve.knots.front(), curve.knots.back()};
}
/// Point and derivatives; outside the domain the end span goes on. O(degree^2 + log n).
template <class V>
[[nodiscard]] NurbsJet<V> evaluate(const Nurbs<V>& curve, double u);

// Operations that leave the shape as it is.
template <class V>
[[nodiscard]] Nurbs<V> reversed(const Nurbs<V>& curve);
/// Knots scaled and moved onto the range.
template <class V>
[[nodiscard]] Nurbs<V> with_domain(const Nurbs<V>& curve, Range range);
/// `new_knots` ascending, inside the domain; each may repeat. Boehm, Oslo form. O(n + new).
template <class V>
[[nodiscard]] Nurbs<V> with_knots(const Nurbs<V>& curve, const std::vector<double>& new_knots);
/// Degree raised to `degree` (not lowered); every inner knot gains the same multiplicity.
template <class V>
[[nodiscard]] Nurbs<V> with_degree(const Nurbs<V>& curve, int degree);
/// The parts before and after u, strictly inside the domain; u stays the knot between them.
template <class V>
[[nodiscard]] std::array<Nurbs<V>, 2> split(const Nurbs<V>& curve, double u);
/// One curve for each span that has a length, over its own two knots: the curve cut at its knots,
/// apart from the rounding of the control points; neighbours share their ends exactly. Knots need
/// not be clamped here. Empty when the degree is not in 1..kMaxNurbsDegree, or the numbers of
/// knots, points and weights do not belong together. O(degree^3) per span.
template <class V>
[[nodiscard]] std::vector<Nurbs<V>> spans(const Nurbs<V>& curve);

/// One knot span of a plane curve as a Bezier piece.
struct BezierSpan {
  double from = 0.0;  ///< knot at its start
  double to = 0.0;    ///< knot at its end
  RationalBezier piece;
};
/// `spans` as pieces; empty for degrees above `kMaxBezierDegree`, too.
[[nodiscard]] std::vector<BezierSpan> bezier_spans(const NurbsCurve& curve);
/// A piece over [0, 1], its control points as plain coordinates.
[[nodiscard]] NurbsCurve nurbs_of(const RationalBezier& piece);

}  // namespace obvid
