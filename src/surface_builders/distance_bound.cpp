// SPDX-License-Identifier: Apache-2.0
#include "distance_bound.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fair_across.h"
#include "row_hull.h"

namespace obvid {

double distance_bound(const NurbsSurface& a, const NurbsSurface& b) {
  NurbsSurface less = b;
  for (Vec3& p : less.points) p = -1.0 * p;
  const NurbsSurface difference = sum_of(a, less);
  const std::size_t along = difference.count_u(), across = difference.count_v();
  OtherWay hull;
  hull.add(difference.degree_v, difference.knots_v);
  std::vector<double> row(3 * across);
  double squared = 0.0;
  for (std::size_t i = 0; i < along; ++i) {
    for (std::size_t j = 0; j < across; ++j) {
      const Vec3 p = difference.points[j * along + i];
      row[3 * j] = p.x;
      row[3 * j + 1] = p.y;
      row[3 * j + 2] = p.z;
    }
    squared = std::max(squared, hull.close_hull.longest_squared(row.data()));
  }
  return std::sqrt(squared);
}

}  // namespace obvid
