// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Points of a surface in rows: point i of row j is `points[j * count_u + i]`.
struct PointGrid {
  std::size_t count_u = 0;  ///< points in a row
  std::size_t count_v = 0;  ///< rows
  std::vector<Vec3> points;
  std::string name;
  Units units{};
  Vec3 rounding{};          ///< half a unit of the last digit printed; 0 when not from text
  bool of_heights = false;  ///< z was read, x and y are columns and rows times a spacing

  [[nodiscard]] const Vec3& at(std::size_t i, std::size_t j) const {
    return points[j * count_u + i];
  }
};

/// A series of points in space: one section of a body, with its name.
struct SpaceSeries {
  std::string name;
  std::vector<Vec3> points;
  std::vector<std::size_t> corners{};  ///< points at which the section turns at once, whatever the
                                       ///< angle, ascending; others are found
  Units units{};
  Vec3 rounding{};  ///< half a unit of the last digit printed; 0 when not from text
};

}  // namespace obvid
