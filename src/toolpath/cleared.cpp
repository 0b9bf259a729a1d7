// SPDX-License-Identifier: Apache-2.0
#include "cleared.h"

#include <algorithm>
#include <cmath>

namespace obvid::toolpath {

// The distance from the passes changes by no more than the place does.
bool Cleared::low_around(Vec2 place, double around, double most) const {
  const auto first =
      std::lower_bound(lines_.begin(), lines_.end(), place.y - cutter_.radius,
                       [](const Line& line, double across) { return line.across < across; });
  for (auto line = first; line != lines_.end() && line->across <= place.y + cutter_.radius;
       ++line) {
    for (const Cut& cut : line->cuts) {
      const double beside = std::max({cut.from - place.x, place.x - cut.to, 0.0});
      const double far = std::hypot(beside, line->across - place.y) + around;
      if (far < cutter_.radius && cutter_.height(far) <= most) return true;
    }
  }
  return false;
}

}  // namespace obvid::toolpath
