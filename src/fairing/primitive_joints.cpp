// SPDX-License-Identifier: Apache-2.0
#include "primitive_joints.h"

#include <cmath>

namespace obvid::fairing_detail {

double foot_on(const Primitive& p, Vec2 point) {
  const Vec2 q = point - p.anchor, tangent = unit_at(p.theta);
  const double u = dot(tangent, q), v = cross(tangent, q);
  if (p.kappa == 0.0) return u;
  return std::atan2(p.kappa * u, 1.0 - p.kappa * v) / p.kappa;
}

std::optional<TangentPlace> tangent_place(const Primitive& a, const Primitive& b) {
  // n: left normal where both headings agree; kappa_a kappa_b times the way between the centres
  const Vec2 na = left_normal(unit_at(a.theta)), nb = left_normal(unit_at(b.theta));
  const double change = a.kappa - b.kappa;
  if (change == 0.0) return std::nullopt;
  const Vec2 centres = a.kappa * b.kappa * (b.anchor - a.anchor) + a.kappa * nb - b.kappa * na;
  const double size = norm(centres);
  if (!(size > 0.0)) return std::nullopt;
  const Vec2 n = (std::copysign(1.0, change) / size) * centres;
  const bool first = std::abs(a.kappa) > std::abs(b.kappa);  // the sharper one has a near centre
  const Primitive &sharp = first ? a : b, &flat = first ? b : a;
  const Vec2 place = sharp.anchor + (1.0 / sharp.kappa) * ((first ? na : nb) - n);
  const double on_sharp = foot_on(sharp, place), on_flat = foot_on(flat, place);
  const Vec2 q = place - flat.anchor, t = unit_at(flat.theta);
  const double u = dot(t, q), v = cross(t, q), k = flat.kappa;
  const double ratio = std::sqrt(1.0 - 2.0 * k * v + k * k * (u * u + v * v));
  const double gap = (2.0 * v - k * (u * u + v * v)) / (1.0 + ratio);
  return first ? TangentPlace{on_sharp, on_flat, gap} : TangentPlace{on_flat, on_sharp, gap};
}

double transition_length(double kappa0, double kappa1, double shift) {
  constexpr double kShift = 24.0;  // length^2 times the change of curvature over the shift
  return std::sqrt(kShift * shift / std::abs(kappa1 - kappa0));
}

}  // namespace obvid::fairing_detail
