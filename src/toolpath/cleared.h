// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "cutter_shape.h"

namespace obvid::toolpath {

/// What the passes of one level have left of the stock over it, seen from above, in the directions
/// of the passes: x along them, y across.
class Cleared {
 public:
  /// Straight passes of the tip.
  struct Cut {
    double from = 0.0, to = 0.0;
    friend bool operator==(const Cut&, const Cut&) = default;
  };

  explicit Cleared(const CutterShape& cutter) : cutter_(cutter) {}

  void add_line(double across, std::vector<Cut> cuts) {
    lines_.push_back({across, std::move(cuts)});
  }
  /// Nowhere in a disc more than `most` stands over the level; `outside`: where there is no stock
  /// at all in any case (a place, and how far from it that holds). Places are looked at so near to
  /// each other that this is so between them, too.
  template <class Outside>
  [[nodiscard]] bool holds(Vec2 centre, double radius, double most, const Outside& outside) const;

 private:
  struct Line {
    double across = 0.0;
    std::vector<Cut> cuts;
  };
  /// Less than `most` over every place within `around` of this one.
  [[nodiscard]] bool low_around(Vec2 place, double around, double most) const;

  CutterShape cutter_;
  std::vector<Line> lines_;  ///< from low to high
};

template <class Outside>
bool Cleared::holds(Vec2 centre, double radius, double most, const Outside& outside) const {
  constexpr double kHalfDiagonal = 0.71;  // of a square of side 1, rounded up
  constexpr int kRings = 12;              // of the squares that cover the disc, from the middle out
  const double step = radius / kRings, around = kHalfDiagonal * step;
  for (int i = -kRings; i <= kRings; ++i) {
    for (int j = -kRings; j <= kRings; ++j) {
      const Vec2 by{i * step, j * step};
      if (norm(by) > radius + around) continue;
      const Vec2 place = centre + by;
      if (!outside(place, around) && !low_around(place, around, most)) return false;
    }
  }
  return true;
}

}  // namespace obvid::toolpath
