// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Points in their order along a curve.
struct CurveOrder {
  std::vector<std::size_t> order;  ///< indices of the points, from one end to the other
  double largest_step = 0.0;       ///< between neighbours, units
  double gap = 0.0;                ///< between the ends, units
  bool is_outline = false;         ///< a short closed way, opened at its longest step
  /// Points whose order it is, where others lie beside them: at least `apart` from each other. 0:
  /// all.
  std::size_t thinned = 0;
  double apart = 0.0;  ///< units
};

/// The order in which points of a curve follow each other, whatever the order of the list: their
/// shortest spanning tree (Prim 1957), which must be a row. It begins at the end that comes first
/// in the list; of a closed curve the longest step is between the ends.
///
/// The order is right where points that are neighbours on the curve are nearer to each other than
/// any two that are not, and in wider cases; elsewhere the row is the shortest tree, and no more is
/// promised. O(n^2), n at most 20,000.
///
/// Where the tree branches (thin parts: a trailing edge) and there are 12 to 3,000 points, a short
/// closed way through all is taken (greedy edges, exchanges of two edges and moves of one to three
/// points: Croes 1958, Or 1976), if it has no rival: no exchange of two edges and no move of one to
/// three points to anywhere else that makes the edges it touches less than 1.7 times as long and
/// turns by less than the smaller of 100 degrees and 10 degrees + what the way turns there, more
/// than the way. Measured, not promised: docs/methods/series.md.
///
/// Errors: E304 fewer than 3 points; E307 more than 20,000; E313 points that coincide, and points
/// without a certain order: that scatter more than they are apart, curves that meet.
[[nodiscard]] Result<CurveOrder> order_along_curve(const std::vector<Vec2>& points);

/// An order of points that are nearer to each other than they scatter across their curve: that of
/// some of them (`order_along_curve`), taken as the list has them where none taken before is nearer
/// than 2, 4, ... 64 times the middle step of the shortest tree, the first distance that leads to
/// one. The others follow each other as their feet on that row do; each is within a quarter of the
/// distance of it, and 40 in a row never lie on two sides of a parabola (a kurtosis below 1.4), as
/// both sides of a thin part do. Neighbours nearer than that distance may follow each other the
/// wrong way round; thin parts of fewer points may be taken for one row.
///
/// Errors: those of `order_along_curve`; E313 where no distance leads to an order, fewer than 20
/// points are left, or a point lies farther off.
[[nodiscard]] Result<CurveOrder> order_beside_row(const std::vector<Vec2>& points);

/// What is said of points that follow each other in no order: where, of 12 points or more, the next
/// one of the list is beyond four times the distance of the nearest one, for the most part. Else
/// nothing. O(n), of 200 points.
[[nodiscard]] std::optional<std::string> no_order_hint(const std::vector<Vec2>& points);

}  // namespace obvid
