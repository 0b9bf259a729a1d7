// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "passes.h"

namespace obvid::toolpath {

/// A place of the part over which too much stays.
struct HighSpot {
  double height = 0.0;  ///< along the normal
  Place place;
};

/// What is left over the part after passes: heights over a raster of places seen from above, from
/// which the true body of the cutter is taken along its way. Nodes stand in the middles of cells,
/// so none stands on a straight border.
class Stock {
 public:
  /// `within`: what may seem left between the points of a pass, at most.
  Stock(const Part& part, double spacing, double within);

  void cut(const Pass& pass);
  /// Nodes where more than `limit` stays though the cutter can touch the part there.
  [[nodiscard]] std::vector<HighSpot> above(double limit);
  /// Where most stays though the cutter can touch the part.
  [[nodiscard]] HighSpot highest();
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  enum class Reach : unsigned char { kUnknown, kYes, kNo };
  struct Node {
    double floor = 0.0;  ///< height of the part
    double top = 0.0;    ///< of the stock
    double lean = 0.0;   ///< z of the normal; 0: nothing of the part here
    Reach reach = Reach::kUnknown;
    [[nodiscard]] double left() const { return (top - floor) * lean; }
  };

  [[nodiscard]] Vec2 at(std::size_t x, std::size_t y) const;
  [[nodiscard]] bool reached(std::size_t x, std::size_t y);
  [[nodiscard]] bool skips(Vec3 a, Vec3 b) const;
  void sweep(Vec3 a, Vec3 b);
  template <class Height>
  void lower(Vec2 low, Vec2 high, const Height& height);

  const Part& part_;
  double spacing_, within_;
  Vec2 low_;
  std::size_t nx_ = 1, ny_ = 1;
  std::vector<Node> nodes_;
};

}  // namespace obvid::toolpath
