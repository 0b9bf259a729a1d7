// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/curve/pieces.h"

namespace obvid {

/// Largest distance between two paths that run alongside each other from their starts to their
/// ends, both ways: of any point of one path from the other. Corners and steps between pieces are
/// allowed. 16 points of each piece, and the place of the largest distance between them: good to
/// some 1 % where the paths are near each other against their radii. Nearest points are followed
/// along the paths, so where a path passes twice near a place it is the pass alongside that
/// counts: never too small but for the sampling. 0 when a path has no pieces. Linear time.
[[nodiscard]] double path_distance(std::span<const Piece> a, std::span<const Piece> b);

}  // namespace obvid
