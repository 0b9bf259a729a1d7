// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

using Edge = std::pair<std::size_t, std::size_t>;

/// Points that are put in order: the tree takes their number squared.
inline constexpr std::size_t kMostOrdered = 20'000;

/// Edges of the shortest spanning tree; of equal ones those of the points that come first [Prim
/// 1957]. O(n^2).
[[nodiscard]] std::vector<Edge> shortest_tree(const std::vector<Vec2>& points);

}  // namespace obvid
