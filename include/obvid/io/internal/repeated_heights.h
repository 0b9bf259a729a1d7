// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace obvid {

/// Heights of points that repeat the one before, whose height is kept.
class RepeatedHeights {
 public:
  void add(double kept, double other);
  /// Adds a warning where any is another; `unit` of heights: empty where none is known.
  void warn(std::string_view unit, std::vector<std::string>& warnings) const;

 private:
  std::size_t others_ = 0;
  double farthest_ = 0.0;
};

}  // namespace obvid
