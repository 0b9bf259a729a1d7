// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Points in their order along a curve.
struct CurveOrder {
  std::vector<std::size_t> order;  ///< indices of the points, from one end to the other
  double largest_step = 0.0;       ///< between neighbours, units
  double gap = 0.0;                ///< between the ends, units
};

/// The order in which points of a curve follow each other, whatever the order of the list: their
/// shortest spanning tree (Prim 1957), which must be a row. It begins at the end that comes first
/// in the list; of a closed curve the longest step is between the ends.
///
/// The order is right where points that are neighbours on the curve are nearer to each other than
/// any two that are not, and in wider cases; elsewhere the row is the shortest tree, and no more is
/// promised. O(n^2), n at most 20,000. Errors: E304 fewer than 3 points; E307 more than 20,000;
/// E313 points that coincide, and trees that branch: points that scatter more than they are apart,
/// curves that meet.
[[nodiscard]] Result<CurveOrder> order_along_curve(const std::vector<Vec2>& points);

}  // namespace obvid
