// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "obvid/geom/element.h"

namespace obvid::known {

/// Element at arc length s of the clothoid kappa = k0 + rate s that starts at the origin along x.
/// Five-point Gauss-Legendre over short steps: the error is below 1e-15 of the length.
inline Element clothoid(double k0, double rate, double s) {
  constexpr std::array<double, 5> kNode = {-0.9061798459386640, -0.5384693101056831, 0.0,
                                           0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 5> kWeight = {0.2369268850561891, 0.4786286704993665,
                                             0.5688888888888889, 0.4786286704993665,
                                             0.2369268850561891};
  constexpr int kSteps = 32;
  Vec2 p;
  const double half = 0.5 * s / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    for (std::size_t j = 0; j < kNode.size(); ++j) {
      const double t = (2 * i + 1 + kNode[j]) * half;
      p = p + half * kWeight[j] * unit_at(k0 * t + 0.5 * rate * t * t);
    }
  }
  return {p, k0 * s + 0.5 * rate * s * s, k0 + rate * s};
}

/// Logarithmic spiral r = e^(b phi): curvature e^(-b phi) / sqrt(1 + b^2), falling for b > 0.
inline Element log_spiral(double b, double phi) {
  const double r = std::exp(b * phi);
  return {r * unit_at(phi), phi + std::atan2(1.0, b), 1.0 / (r * std::hypot(1.0, b))};
}

/// Involute of the unit circle: heading t, curvature 1/t.
inline Element involute(double t) {
  return {{std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)}, t, 1.0 / t};
}

/// Point of the Moebius image of a hyperbola with these end data over the chord (0,0)-(h,0), for
/// increasing curvature; tau from 1 (start) to 0 (end).
inline Vec2 hyperbola_image(double h, double alpha, double beta, double kappa0, double kappa1,
                            double tau) {
  using Complex = std::complex<double>;
  const Complex i(0.0, 1.0);
  const double sigma = alpha + beta;
  const double A = 0.5 * h * kappa0 + std::sin(alpha), B = 0.5 * h * kappa1 - std::sin(beta);
  const double rho = std::sin(sigma) * std::sin(sigma) / (-A * B);
  const Complex b = 1.0 - rho * std::exp(i * sigma);
  const Complex d = -(rho * std::sin(sigma) / B) * std::exp(i * beta);
  const Complex z =
      (1.0 - (1.0 + b - d) * tau + b * tau * tau) / (1.0 - (1.0 + b + d) * tau + b * tau * tau);
  return {0.5 * h * (z.real() + 1.0), 0.5 * h * z.imag()};
}

/// A point in the frame of a chord.
inline Vec2 in_frame(Vec2 p, Vec2 start, Vec2 end) {
  const Vec2 u = (end - start) / norm(end - start);
  return {dot(u, p - start), cross(u, p - start)};
}

}  // namespace obvid::known
