// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/circle.h"

namespace obvid::pipeline_detail {

/// A line or circle by a point of it.
struct Shape {
  Vec2 anchor;
  double theta = 0.0, kappa = 0.0;

  [[nodiscard]] double off(Vec2 p) const {
    return distance_beside_circle(anchor, unit_at(theta), kappa, p);
  }
  /// Arc length from the anchor to the foot of a point; within half a turn.
  [[nodiscard]] double foot(Vec2 p) const {
    const Vec2 t = unit_at(theta), from = p - anchor;
    if (kappa == 0.0) return dot(from, t);
    return std::atan2(kappa * dot(from, t), 1.0 - kappa * dot(from, left_normal(t))) / kappa;
  }
  [[nodiscard]] Vec2 at(double s) const {
    const double half = 0.5 * kappa * s, chord = half == 0.0 ? s : s * std::sin(half) / half;
    return anchor + chord * unit_at(theta + half);
  }
};

/// Points with how far each may be off.
struct ShapePoints {
  std::vector<Vec2> at;
  std::vector<double> reach;
};

/// The line or circle of least squares where that stays within all reaches and passes the points in
/// their order, else one that does; nothing where none is found. Four points at least for an arc.
[[nodiscard]] std::optional<Shape> shape_within(const ShapePoints& points, bool arc);

/// Where two of them meet near a place.
[[nodiscard]] std::optional<Vec2> meeting(const Shape& a, const Shape& b, Vec2 near);

}  // namespace obvid::pipeline_detail
