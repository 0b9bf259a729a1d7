// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "passes.h"

namespace obvid::toolpath {

/// What neighbouring passes leave, and where along the rail it is too much.
struct Gap {
  double scallop = 0.0;
  bool too_high = false;
  double from = 1.0, to = 0.0;  ///< t of the rail
  std::vector<Place> high;      ///< where it is too much
};

/// Measures what the cutter leaves over the surface: all places of the cutter, in a raster.
class ScallopMeter {
 public:
  ScallopMeter(const Part& part, double allowed);  ///< scallop

  void add(const Pass& pass);
  /// Between two passes of a family, half way and at thirds between their contacts, where the
  /// cutter can touch the surface without cutting elsewhere. `spacing`: between measured places.
  [[nodiscard]] Gap between(const Pass& a, const Pass& b, double spacing) const;
  /// Along the normal of a place of the part, up to some allowed scallops.
  [[nodiscard]] double left_over(const Place& q) const;

 private:
  [[nodiscard]] double distance(Vec3 p) const;  ///< from the nearest place of the cutter
  [[nodiscard]] bool says_the_same(Vec3 a, Vec3 b) const;
  void look_at(Vec3 middle, double reach, Gap& gap, double from, double to) const;
  void measure(const PassPoint& a, const PassPoint& b, Gap& gap) const;
  [[nodiscard]] std::size_t cell(double value, double low, std::size_t count) const;

  const Part& part_;
  double allowed_;
  Vec2 low_;
  double size_ = 1.0;  ///< of a cell
  std::size_t nx_ = 1, ny_ = 1;
  std::vector<std::vector<Vec3>> cells_;
};

/// How far above its touching place the cutter is held by other parts, along the normal; below 0
/// or near it: it can touch.
[[nodiscard]] double held_up(const Part& part, const Place& surface);

}  // namespace obvid::toolpath
