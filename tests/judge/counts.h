// SPDX-License-Identifier: Apache-2.0
// Vertices and inflections of a whole contour.
#pragma once

#include "course.h"

namespace judge {

/// Changes of sign that are certain, and with those that rounding may make or hide.
struct CountRange {
  int least = 0, most = 0;
  bool known = true;
};
CountRange count_vertices(const Course& course);
CountRange count_inflections(const Course& course);

}  // namespace judge
