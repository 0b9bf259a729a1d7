// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/series/internal/order.h"
#include "spanning_tree.h"

namespace obvid {

/// E304, E307: numbers of points that `order_along_curve` refuses.
[[nodiscard]] Result<void> check_order_count(const std::vector<Vec2>& points);

/// The order of `order_along_curve`, of points whose shortest tree is known.
[[nodiscard]] Result<CurveOrder> order_by_tree(const std::vector<Vec2>& points,
                                               const std::vector<Edge>& tree);

}  // namespace obvid
