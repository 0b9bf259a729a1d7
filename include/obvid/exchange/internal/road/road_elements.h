// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// What road and rail formats know: from `start` with heading `theta` along `length`, curvature
/// changing linearly from `kappa0` to `kappa1`.
struct RoadElement {
  double s = 0.0;  ///< length before it on its line
  Vec2 start, end;
  double theta = 0.0;
  double kappa0 = 0.0, kappa1 = 0.0;
  double length = 0.0;

  [[nodiscard]] bool is_line() const { return kappa0 == 0.0 && kappa1 == 0.0; }
  [[nodiscard]] bool is_arc() const { return kappa0 == kappa1 && kappa0 != 0.0; }
};

/// Elements without a corner between them.
struct RoadLine {
  std::vector<RoadElement> elements;
  double length = 0.0;
};

/// A contour of lines, arcs and clothoids as elements in `unit`, exactly but for the rounding of
/// the change of units; a new line begins at each corner. Linear time. Errors: E310 a piece of
/// another kind, E203 a unit that is no known length, E304 a contour without pieces.
[[nodiscard]] Result<std::vector<RoadLine>> road_lines(const Contour& contour,
                                                       std::string_view unit);

}  // namespace obvid
