// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinds.h"
#include "obvid/core/units.h"

namespace obvid {
namespace {

/// Cosine and sine about the axis as the arc of radius 1 that the NURBS form uses.
SpaceCurve turn(double angle) { return arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, angle); }

/// Direction of the axis; its square may be too large or too small for a number.
Vec3 axis_of(const RevolutionSurface& s) {
  const Vec3& d = s.axis_direction;
  const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  return most > 0.0 ? unit(d / most) : d;
}

/// A vector turned: its part along the axis stays.
Vec3 turned(Vec3 vector, Vec3 axis, double cosine, double sine) {
  const Vec3 along = dot(vector, axis) * axis, x = vector - along;
  return along + cosine * x + sine * cross(axis, x);
}

/// Derivative by the turn: without the part along the axis.
Vec3 moved(Vec3 vector, Vec3 axis, double cosine, double sine) {
  const Vec3 x = vector - dot(vector, axis) * axis;
  return cosine * x + sine * cross(axis, x);
}

}  // namespace

SurfaceJet evaluate_kind(const RevolutionSurface& s, double u, double v) {
  const Vec3 axis = axis_of(s);
  const SpaceJet p = evaluate_unit(s.profile, u);
  const SpaceJet t = evaluate(turn(s.angle), v);
  const Vec3 arm = p.point - s.axis_point;
  return {s.axis_point + turned(arm, axis, t.point.x, t.point.y),
          turned(p.d1, axis, t.point.x, t.point.y),
          moved(arm, axis, t.d1.x, t.d1.y),
          turned(p.d2, axis, t.point.x, t.point.y),
          moved(p.d1, axis, t.d1.x, t.d1.y),
          moved(arm, axis, t.d2.x, t.d2.y)};
}

Result<NurbsForm> nurbs_of(const RevolutionSurface& s, double) {
  OBVID_TRY(check(s.profile));
  if (!is_finite(s.axis_point) || !is_finite(s.axis_direction)) {
    return error(ErrorCode::kNotFinite, "the axis is not finite");
  }
  if (s.axis_direction == Vec3{}) {
    return error(ErrorCode::kBadOption, "the axis has no direction");
  }
  constexpr double kFull = kFullTurn * (1.0 + 1e-12);  // a full turn, rounded
  if (!(std::abs(s.angle) > 0.0 && std::abs(s.angle) <= kFull)) {
    return error(ErrorCode::kBadOption, "the angle must be more than 0 and at most a full turn")
        .value(s.angle);
  }
  const Vec3 axis = axis_of(s);
  const SpaceCurve profile = with_domain(s.profile, {0.0, 1.0});
  const std::size_t n = profile.points.size();
  NurbsSurface out{profile.degree, 2, profile.knots, turn(s.angle).knots, {}, {}};
  const std::size_t rows = out.count_v();
  out.points.resize(n * rows);
  out.weights.resize(n * rows);
  for (std::size_t i = 0; i < n; ++i) {
    const SpaceCurve arc = arc_about(profile.points[i], s.axis_point, axis, s.angle);
    const double w = profile.weights.empty() ? 1.0 : profile.weights[i];
    for (std::size_t j = 0; j < rows; ++j) {
      out.points[j * n + i] = arc.points[j];
      out.weights[j * n + i] = w * arc.weights[j];
    }
  }
  return NurbsForm{std::move(out), 0.0};
}

}  // namespace obvid
