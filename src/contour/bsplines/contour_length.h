// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/contour.h"

namespace obvid::bsplines {

/// Arc length along a whole contour. Places are numbers: piece plus parameter on it.
class ContourLength {
 public:
  explicit ContourLength(const Contour& contour);

  /// Arc length from the start of the contour.
  [[nodiscard]] double at(double place) const;

  /// Point, heading (unwrapped from the start of its piece) and curvature. Joints are taken from
  /// the contour's own table.
  [[nodiscard]] Element element(double place) const;

  [[nodiscard]] Vec2 point(double place) const;

 private:
  struct Place {
    std::size_t piece;
    double t;
  };
  [[nodiscard]] Place split(double place) const;

  const Contour& contour_;
  std::vector<double> cells_;  ///< arc length at the start of every cell, and at the end
};

}  // namespace obvid::bsplines
