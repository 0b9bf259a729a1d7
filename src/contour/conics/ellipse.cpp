// SPDX-License-Identifier: Apache-2.0
// Ellipse parameters and monotone test: docs/methods/conics.md, sections 1 and 2.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/contour/conics.h"

namespace obvid {
namespace {

/// Square of the middle weight once both end weights are 1 (a Moebius change of the parameter).
double squared_weight(const RationalBezier& c) {
  return c.weight[1] * c.weight[1] / (c.weight[0] * c.weight[2]);
}

bool positive_quadratic(const RationalBezier& c) {
  return c.degree == 2 && c.weight[0] > 0.0 && c.weight[1] > 0.0 && c.weight[2] > 0.0;
}

}  // namespace

std::optional<Ellipse> ellipse_of(const RationalBezier& conic) {
  if (!positive_quadratic(conic)) return std::nullopt;
  const double square = squared_weight(conic), rest = 1.0 - square;
  const Vec2 along = 0.5 * (conic.offset[2] - conic.offset[0]);
  const Vec2 foot = conic.offset[0] + along;
  const Vec2 median = conic.offset[1] - foot;
  if (!(rest > 0.0) || cross(along, median) == 0.0) return std::nullopt;
  // conjugate half diameters; the arc runs from pi - f to f on the side of the apex
  const double weight = std::sqrt(square);
  const Vec2 p = along / std::sqrt(rest), q = (weight / rest) * median;
  const double f = std::atan2(weight, std::sqrt(rest));
  double tau = 0.5 * std::atan2(2.0 * dot(p, q), dot(p, p) - dot(q, q));
  Vec2 major = std::cos(tau) * p + std::sin(tau) * q;
  const Vec2 minor = std::cos(tau) * q - std::sin(tau) * p;
  if (major.x < 0.0 || (major.x == 0.0 && major.y < 0.0)) {  // the same axis the other way round
    major = -major;
    tau += std::numbers::pi;
  }
  Ellipse e;
  e.centre = conic.origin + (foot - (square / rest) * median);
  e.semi_major = norm(major);
  e.semi_minor = norm(minor);
  e.rotation = heading(major);
  const double way = cross(p, q) > 0.0 ? 1.0 : -1.0;
  e.from = way * (std::numbers::pi - f - tau);
  e.to = way * (f - tau);
  return e;
}

int conic_direction(const RationalBezier& conic) {
  if (!positive_quadratic(conic)) return 0;
  const Vec2 a = conic.offset[1] - conic.offset[0], b = conic.offset[2] - conic.offset[1];
  const double A = dot(a, a), B = dot(b, b), D = dot(a, b), twice = 2.0 * squared_weight(conic);
  // The inner two coefficients are the outer ones plus (B - A)/2, so they add nothing.
  const double falls[] = {A + D - twice * A, B - A, twice * B - B - D};
  const auto is = [&](auto sign) { return std::all_of(std::begin(falls), std::end(falls), sign); };
  const int turning = cross(a, b) > 0.0 ? 1 : -1;
  const bool strict = falls[1] != 0.0;
  if (strict && is([](double c) { return c >= 0.0; })) return -turning;
  if (strict && is([](double c) { return c <= 0.0; })) return turning;
  return 0;
}

}  // namespace obvid
