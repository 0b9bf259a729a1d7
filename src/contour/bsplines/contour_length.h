// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"
#include "obvid/curve/internal/contour_path.h"

namespace obvid::bsplines {

/// Arc length along a whole contour. Places are numbers: piece plus parameter on it.
class ContourLength {
 public:
  explicit ContourLength(const Contour& contour) : contour_(contour), path_(contour.pieces) {}
  /// Worth nothing when it was cancelled.
  ContourLength(const Contour& contour, Watch& watch)
      : contour_(contour), path_(contour.pieces, kFinestLength, &watch) {}

  /// Arc length from the start of the contour.
  [[nodiscard]] double at(double place) const {
    const Place p = split(place);
    return path_.length_at(p.piece, p.t);
  }

  /// Point, heading (unwrapped from the start of its piece) and curvature. Joints are taken from
  /// the contour's own table.
  [[nodiscard]] Element element(double place) const;

  [[nodiscard]] Vec2 point(double place) const;

 private:
  using Place = ContourPath::Parameter;
  [[nodiscard]] Place split(double place) const;

  const Contour& contour_;
  ContourPath path_;
};

}  // namespace obvid::bsplines
