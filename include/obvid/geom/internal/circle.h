// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Of a point from the whole line (`kappa` 0) or circle that leaves `start` along a unit vector,
/// without the cancellation of a large circle; to the left positive.
[[nodiscard]] inline double distance_beside_circle(Vec2 start, Vec2 tangent, double kappa, Vec2 p) {
  const Vec2 from = p - start, left = left_normal(tangent);
  return (2.0 * dot(from, left) - kappa * dot(from, from)) / (1.0 + norm(kappa * from - left));
}

/// The same with a heading, without a sign.
[[nodiscard]] inline double distance_from_circle(Vec2 start, double theta, double kappa, Vec2 p) {
  return std::abs(distance_beside_circle(start, unit_at(theta), kappa, p));
}

struct LeastSquaresCircle {
  Vec2 centre;
  double radius = 0.0;
};

/// The circle of least squares of the squares of distances: around a circle, it is nearly
/// the one of the distances. Nothing of points on a line.
[[nodiscard]] inline std::optional<LeastSquaresCircle> circle_of_squares(
    const std::vector<Vec2>& points) {
  const auto n = static_cast<double>(points.size());
  Vec2 middle{};
  for (const Vec2 p : points) middle = middle + p / n;
  double xx = 0.0, xy = 0.0, yy = 0.0, x_square = 0.0, y_square = 0.0, square = 0.0;
  for (const Vec2 p : points) {
    const Vec2 d = p - middle;
    const double s = dot(d, d);
    xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    x_square += d.x * s, y_square += d.y * s, square += s;
  }
  const double det = 2.0 * (xx * yy - xy * xy);
  if (!(det > 0.0)) return std::nullopt;
  const Vec2 off = Vec2{yy * x_square - xy * y_square, xx * y_square - xy * x_square} / det;
  return LeastSquaresCircle{middle + off, std::sqrt(square / n + dot(off, off))};
}

/// Whether each point is within its reach of that circle.
[[nodiscard]] inline bool are_near_circle_of_squares(const std::vector<Vec2>& points,
                                                     const std::vector<double>& reach) {
  const auto circle = circle_of_squares(points);
  if (!circle) return false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = norm(points[i] - circle->centre) - circle->radius;
    if (!(std::abs(away) <= reach[i])) return false;
  }
  return true;
}

}  // namespace obvid
