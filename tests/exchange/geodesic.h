// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "obvid/exchange/internal/geo/projection.h"

namespace obvid {

/// Length of the geodesic between two places on WGS84, metres (Vincenty, Survey Review 23, 1975; to
/// 0.1 mm where the places are not nearly antipodal).
inline double geodesic_distance(GeoPoint p, GeoPoint q) {
  constexpr double kA = 6378137.0, kF = 1.0 / 298.257223563, kB = kA * (1.0 - kF);
  constexpr double kDegree = std::numbers::pi / 180.0;
  const double l = kDegree * std::remainder(q.longitude - p.longitude, 360.0);
  const double u1 = std::atan((1.0 - kF) * std::tan(kDegree * p.latitude));
  const double u2 = std::atan((1.0 - kF) * std::tan(kDegree * q.latitude));
  double lambda = l, sigma = 0.0, sin_sigma = 0.0, cos_sigma = 1.0, cos2 = 1.0, middle = 0.0;
  for (int k = 0; k < 100; ++k) {
    const double a = std::cos(u2) * std::sin(lambda);
    const double b = std::cos(u1) * std::sin(u2) - std::sin(u1) * std::cos(u2) * std::cos(lambda);
    sin_sigma = std::hypot(a, b);
    if (sin_sigma == 0.0) return 0.0;
    cos_sigma = std::sin(u1) * std::sin(u2) + std::cos(u1) * std::cos(u2) * std::cos(lambda);
    sigma = std::atan2(sin_sigma, cos_sigma);
    const double sin_alpha = std::cos(u1) * std::cos(u2) * std::sin(lambda) / sin_sigma;
    cos2 = 1.0 - sin_alpha * sin_alpha;
    middle = cos2 > 0.0 ? cos_sigma - 2.0 * std::sin(u1) * std::sin(u2) / cos2 : 0.0;
    const double c = kF / 16.0 * cos2 * (4.0 + kF * (4.0 - 3.0 * cos2));
    const double next =
        l + (1.0 - c) * kF * sin_alpha *
                (sigma + c * sin_sigma * (middle + c * cos_sigma * (2.0 * middle * middle - 1.0)));
    const bool done = std::abs(next - lambda) < 1e-15;
    lambda = next;
    if (done) break;
  }
  const double square = cos2 * (kA * kA - kB * kB) / (kB * kB);
  const double big_a =
      1.0 + square / 16384.0 * (4096.0 + square * (-768.0 + square * (320.0 - 175.0 * square)));
  const double big_b =
      square / 1024.0 * (256.0 + square * (-128.0 + square * (74.0 - 47.0 * square)));
  const double change = big_b * sin_sigma *
                        (middle + big_b / 4.0 *
                                      (cos_sigma * (2.0 * middle * middle - 1.0) -
                                       big_b / 6.0 * middle * (4.0 * sin_sigma * sin_sigma - 3.0) *
                                           (4.0 * middle * middle - 3.0)));
  return kB * big_a * (sigma - change);
}

}  // namespace obvid
