// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// Data that a designer fixes at one point, beyond its position.
struct FixedData {
  std::optional<double> theta;      ///< heading, rad
  std::optional<double> kappa;      ///< signed curvature, 1/unit
  std::optional<double> tolerance;  ///< how far the point may move, units
  bool corner = false;              ///< the contour may turn here at once (G0)
};

/// Points in the order in which they were read.
struct PointSeries {
  std::string name;  ///< title of the file, or its name
  std::string units = "mm";
  std::vector<Vec2> points;
  std::vector<FixedData> fixed;       ///< empty, or one entry per point
  Vec2 rounding;  ///< half a unit of the last printed digit of x and of y; 0 when not from text
  std::vector<std::string> warnings;  ///< sentences for the user, e.g. merged duplicates
};

}  // namespace obvid
