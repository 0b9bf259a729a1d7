// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid {

/// Family of curves that carries the contour.
enum class Carrier { kSpiral, kArcs, kClothoids };

[[nodiscard]] const char* to_string(Carrier carrier);

/// A joint of the contour: point, heading, curvature, and the input point it stands on, if any.
struct Joint {
  Element element;
  std::optional<std::size_t> source;  ///< index into `Contour::points`
  std::optional<Element> leaving{};   ///< at a corner: heading and curvature after it; the contour
                                      ///< is continuous in position only
};

/// Maximal part with curvature changing one way; pieces are counted from 0, both ends included.
struct Run {
  std::size_t first_piece = 0;
  std::size_t last_piece = 0;
  int direction = 0;  ///< +1 signed curvature increases, -1 decreases, 0 constant
};

/// A whole contour: pieces in order, each starting where the one before ends.
/// `joints.size()` is `pieces.size() + 1` for an open contour, `pieces.size()` for a closed one,
/// whose first joint is its last one too.
struct Contour {
  std::string units = "mm";
  bool closed = false;
  Carrier carrier = Carrier::kSpiral;
  std::vector<Vec2> points;             ///< input points as read (consecutive duplicates merged)
  std::vector<double> point_tolerance;  ///< per point: how far from it the contour may pass, units;
                                        ///< empty: it passes through all of them
  std::vector<Joint> joints;
  std::vector<Piece> pieces;
  std::vector<Run> runs;
};

}  // namespace obvid
