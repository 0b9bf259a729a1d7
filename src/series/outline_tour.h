// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid {

/// A short closed way through all points: greedy edges, then exchanges of two edges and moves of
/// one to three points as long as they shorten it (2-opt, or-opt). No shortest one is promised.
/// O(n^2) time, points differ, three at least.
[[nodiscard]] std::vector<std::size_t> short_tour(const std::vector<Vec2>& points);

/// Whether all neighbours of the closed way are neighbours of the row, but for one pair.
[[nodiscard]] bool same_neighbours(const std::vector<std::size_t>& row,
                                   const std::vector<std::size_t>& tour);

/// A point where the row turns by more than a right angle.
[[nodiscard]] std::optional<std::size_t> sharp_turn(const std::vector<Vec2>& points,
                                                    const std::vector<std::size_t>& row);

/// An end of the row that may as well lie between two other neighbours, less than 1.7 times as
/// long.
[[nodiscard]] std::optional<std::size_t> uncertain_end(const std::vector<Vec2>& points,
                                                       const std::vector<std::size_t>& row);

/// A point where the way may be joined otherwise with hardly more length and turning, which leaves
/// the order uncertain; nothing where there is none (see order_along_curve). Of an open way the
/// ends stay what they are.
[[nodiscard]] std::optional<std::size_t> uncertain_place(const std::vector<Vec2>& points,
                                                         const std::vector<std::size_t>& way,
                                                         bool closed);

}  // namespace obvid
