// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid {

/// Part of a piece, and how its curvature changes at both its ends.
struct MonotonePart {
  RationalBezier piece;
  int first_change = 0;  ///< +1 curvature increases, -1 decreases, 0 not known
  int last_change = 0;   ///< differs from the former where a vertex lies inside
};

/// Parts of the pieces that have vertices inside, by the index of the piece.
using MonotoneParts = std::map<std::size_t, std::vector<MonotonePart>>;

/// Halves a piece until the curvature of every part is proved to be monotone, or the part is so
/// short that it can only be the place of a vertex. The halves are rounded, and seen from the
/// piece's start: they serve to count vertices and inflections, not to prove them.
[[nodiscard]] std::vector<MonotonePart> monotone_parts(const RationalBezier& piece);

}  // namespace obvid
