// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/internal/box.h"
#include "obvid/surface_cut/internal/trim.h"

namespace obvid {

/// Distance from a closed contour in space, along its projection constant: > 0 inside.
class ContourField {
 public:
  /// Error: E203 a contour that does not return to its begin within `small` units.
  [[nodiscard]] static Result<ContourField> of(const ProjectedContour& contour, double small);

  [[nodiscard]] double value(Vec3 p) const;
  /// Normal of the contour at the nearest point, inwards.
  [[nodiscard]] Vec3 rise(Vec3 p) const;
  /// Where the contour turns at once: points of it, and its axis.
  struct Corner {
    Vec3 point;
    Vec3 x, y;  ///< axes of its plane
  };
  [[nodiscard]] const std::vector<Corner>& corners() const { return corners_; }
  /// Whether the box of the points lies beside that of the contour.
  [[nodiscard]] bool is_beside(const std::vector<Vec3>& points) const;

 private:
  struct Sample {
    std::size_t curve = 0;
    double t = 0.0;
    Vec2 point;
  };
  struct Foot {
    std::size_t curve = 0;
    double t = 0.0;
    Vec2 off;  ///< from there to the point
  };
  [[nodiscard]] Foot foot(Vec2 p) const;
  [[nodiscard]] Vec2 along(std::size_t curve, double t, bool after) const;

  Frame frame_;
  std::vector<NurbsCurve> curves_;  ///< smooth, counter-clockwise, inside to the left
  std::vector<Sample> samples_;
  std::vector<Corner> corners_;
  Box2 box_;
};

}  // namespace obvid
