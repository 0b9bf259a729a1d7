// SPDX-License-Identifier: Apache-2.0
#include "triangle.h"

#include <cmath>
#include <numbers>

namespace obvid::conics {

std::optional<Triangle> triangle_over(const Element& start, const Element& end) {
  const Vec2 chord = end.point - start.point;
  Triangle t;
  t.h = norm(chord);
  const double alpha = turning(chord, unit_at(start.theta));
  const double beta = turning(chord, unit_at(end.theta));
  t.turning = beta > 0.0 ? 1 : -1;
  t.phi = -t.turning * alpha;
  t.psi = t.turning * beta;
  if (!(t.h > 0.0 && t.phi > 0.0 && t.psi > 0.0 && t.phi + t.psi < std::numbers::pi)) {
    return std::nullopt;
  }
  const double across = std::log(t.h / std::sin(t.phi + t.psi));
  t.log_a = across + std::log(std::sin(t.psi));
  t.log_b = across + std::log(std::sin(t.phi));
  t.apex = std::exp(t.log_a) * unit_at(start.theta);
  return t;
}

SquaredWeights monotone_squares(double phi, double psi) {
  // w^2 = (A + D)/(2A) at the start and (B + D)/(2B) at the end
  const double a = std::sin(psi), b = std::sin(phi), turn = std::cos(phi + psi);
  const auto log_of = [](double twice) { return twice > 0.0 ? std::log(0.5 * twice) : -INFINITY; };
  return {log_of(1.0 + b / a * turn), log_of(1.0 + a / b * turn)};
}

double log_start_curvature(const Triangle& t) {
  return std::log(0.5 * t.h * std::sin(t.phi)) - 2.0 * t.log_a;  // S/a^3, S = a h sin(phi)/2
}

double log_end_curvature(const Triangle& t) {
  return std::log(0.5 * t.h * std::sin(t.psi)) - 2.0 * t.log_b;
}

RationalBezier conic(const Element& start, const Element& end, const Triangle& t, double weight) {
  RationalBezier piece;
  piece.degree = 2;
  // the side whose tangent is farther from the chord gives the apex from its own end
  const Vec2 from_end = end.point - std::exp(t.log_b) * unit_at(end.theta);
  const Vec2 from_start = start.point + t.apex;
  piece.offset = {start.point, t.log_a < t.log_b ? from_start : from_end, end.point};
  piece.weight = {1.0, weight, 1.0};
  return piece;
}

}  // namespace obvid::conics
