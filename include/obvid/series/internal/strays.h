// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <vector>

#include "obvid/geom/vec2.h"
#include "obvid/series/internal/order.h"
#include "obvid/series/internal/outliers.h"

namespace obvid {

/// The order of points in no order without those that stray, and how far these are off.
struct OrderBesideStrays {
  CurveOrder order;  ///< of the others; indices are those of the list
  Outliers strays;   ///< indices are those of the list
};

/// Points beside a curve that keep the others from having an order: twigs of one to three points
/// of the shortest spanning tree, without which `order_along_curve` has an order, each of them off
/// the curve of its neighbours there as far as `outliers_of` asks for, while these follow one
/// another and go straight on. Nothing where there are no such points, fewer than 20 others can be
/// compared, or more than a tenth of the points would stray. O(n^2), n at most 20,000.
[[nodiscard]] std::optional<OrderBesideStrays> order_beside_strays(const std::vector<Vec2>& points);

/// The same row without up to three points at each of its ends that are off the parabola of the six
/// behind them four times as far as any other point of the row is off that of the six beside it,
/// and by a quarter of the middle step, where these six go on as the row does. Such points hang on
/// an end: the others have an order with them. Nothing where there are none, of outlines and rows
/// whose ends are as near as three steps, and of fewer than 38 points. O(n log n).
[[nodiscard]] std::optional<OrderBesideStrays> without_end_strays(const std::vector<Vec2>& points,
                                                                  const CurveOrder& order);

}  // namespace obvid
