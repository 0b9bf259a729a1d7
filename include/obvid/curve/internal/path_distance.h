// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/core/internal/watch.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Upper bound of the largest distance between two paths that run alongside each other from their
/// starts to their ends, both ways: of any point of one path from the other. Corners and steps
/// between pieces are allowed. At most 0.1 % (and some roundings of the coordinates) above the
/// largest distance that was found. 16 points of each piece to begin with, and more where the bound
/// asks for them; it takes for granted that no second derivative between two points is more than
/// twice what it is at these and in the middle. Nearest points are followed along the paths, so
/// where a path passes twice near a place it is the pass alongside that counts. 0 when a path has
/// no pieces. Linear time. Where `watch` ends it what it has by then is no bound.
[[nodiscard]] double path_distance(std::span<const Piece> a, std::span<const Piece> b,
                                   Watch* watch = nullptr);

}  // namespace obvid
