// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid {

/// Parts of the pieces that have vertices inside, by the index of the piece.
using MonotoneParts = std::map<std::size_t, std::vector<RationalBezier>>;

/// Halves a piece until the curvature of every part is proved to be monotone, or the part is so
/// short that it can only be the place of a vertex. The halves are rounded, and seen from the
/// piece's start: they serve to count inflections, not to prove them.
[[nodiscard]] std::vector<RationalBezier> monotone_parts(const RationalBezier& piece);

}  // namespace obvid
