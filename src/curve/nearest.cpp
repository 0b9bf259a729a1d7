// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/nearest.h"

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/chord.h"

namespace obvid {
namespace {

constexpr int kNewtonSteps = 40;    // towards a nearest point
constexpr double kFootStep = 1e-7;  // of a piece: the step after it would be the square of it

double nearest_on(const LinePiece& line, Vec2 p, double) {
  return part_of_chord(p, line.start, line.end);
}

double nearest_on(const ArcPiece& arc, Vec2 p, double) {
  const Vec2 v = p - arc.start, tangent = unit_at(arc.theta0);
  const double along = dot(v, tangent), across = cross(tangent, v);
  const double whole = arc.kappa * arc.length;
  double turn = std::atan2(arc.kappa * along, 1.0 - arc.kappa * across);
  // of the turns that mean the same direction the one nearest to the middle of the arc
  turn = nearest_angle(turn, 0.5 * whole);
  const double t = whole != 0.0 ? turn / whole : along / arc.length;
  return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0;
}

/// Newton's method from `t` between places where the distance still falls and rises again.
template <class Curve>
double nearest_on(const Curve& piece, Vec2 p, double t) {
  double low = 0.0, high = 1.0;
  bool low_tried = false, high_tried = false;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Jet jet = evaluate(piece, t);
    const Vec2 away = jet.point - p;
    const double slope = dot(away, jet.d1);
    const double bend = dot(jet.d1, jet.d1) + dot(away, jet.d2);
    (slope < 0.0 ? low : high) = t;
    (slope < 0.0 ? low_tried : high_tried) = true;
    const double step = bend > 0.0 ? -slope / bend : HUGE_VAL;
    if (std::abs(step) < kFootStep) return std::clamp(t + step, 0.0, 1.0);
    double next = bend > 0.0 ? t + step : (slope < 0.0 ? high : low);
    if (next >= high) next = high_tried ? 0.5 * (low + high) : high;
    if (next <= low) next = low_tried ? 0.5 * (low + high) : low;
    if (next == t) break;
    t = next;
  }
  return t;
}

}  // namespace

double nearest_parameter(const Piece& piece, Vec2 p, double t) {
  return std::visit([&](const auto& kind) { return nearest_on(kind, p, t); }, piece);
}

}  // namespace obvid
