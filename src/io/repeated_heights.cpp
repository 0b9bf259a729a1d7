// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/repeated_heights.h"

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/figures.h"

namespace obvid {

void RepeatedHeights::add(double kept, double other) {
  const double off = std::abs(other - kept);
  others_ += off > 0.0 ? 1 : 0;
  farthest_ = std::max(farthest_, off);
}

void RepeatedHeights::warn(std::string_view unit, std::vector<std::string>& warnings) const {
  if (others_ == 0) return;
  std::string off = significant_above(farthest_, 3);
  if (!unit.empty()) off += " " + std::string(unit);
  warnings.push_back(counted(others_, "point", "points") +
                     (others_ == 1 ? " that repeats the point before has another height, up to "
                                   : " that repeat the point before have another height, up to ") +
                     off + " off: that of the point before is kept");
}

}  // namespace obvid
