// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "dxf/entities.h"
#include "obvid/curve/pieces.h"

namespace obvid::dxf {

/// Affine map of space: linear part by rows, then translation.
struct Affine {
  std::array<std::array<double, 3>, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Point3 shift;
};

[[nodiscard]] Affine operator*(const Affine& second, const Affine& first);
[[nodiscard]] Point3 apply(const Affine& map, Point3 p);
/// From the plane with this normal to space: DXF's "arbitrary axis algorithm".
[[nodiscard]] Affine plane_to_space(Point3 normal);
[[nodiscard]] Affine scaling(Point3 factors);
[[nodiscard]] Affine translation(Point3 by);
/// Rotation about z.
[[nodiscard]] Affine rotation(double degrees);

/// What an entity is in the plane.
struct Shape {
  std::vector<Piece> pieces;
  bool closed = false;
  std::vector<Vec2> points;        ///< instead of pieces: fit points, a single point
  std::optional<Vec2> start, end;  ///< directions of the spline through fit points
  std::size_t arcs_more = 0;       ///< pieces beyond the arcs that are drawn
  bool polygon = false;          ///< a polyline without arcs: its vertices may be points of a curve
  double low = 0.0, high = 0.0;  ///< range of heights
  Fault fault;                   ///< nothing is drawn
};

/// The shape of an entity (no insert) that `map` puts into place.
[[nodiscard]] Shape shape_of(const Entity& entity, const Affine& map);

}  // namespace obvid::dxf
