// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/core/result.h"

namespace obvid {

/// Coordinate of a place on something of this size: as many decimals as tell a millionth of it.
[[nodiscard]] std::string coordinate(double value, double size);

/// Radius of a signed curvature for a table; "straight" for 0.
[[nodiscard]] std::string radius_text(double kappa);
/// The same of what has that length; "straight" where a line is nowhere farther from it than
/// `within`.
[[nodiscard]] std::string radius_over(double kappa, double length, double within);

/// Direction of curvature along the way: increasing, decreasing, constant.
[[nodiscard]] const char* direction_text(int direction);

/// Lines "label   value", values aligned.
class Facts {
 public:
  void add(std::string label, std::string value);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& lines() const {
    return lines_;
  }

 private:
  std::vector<std::pair<std::string, std::string>> lines_;
};

}  // namespace obvid
