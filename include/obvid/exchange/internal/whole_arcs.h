// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid::exchange {

/// Neighbours on one circle as one arc, of a whole turn at most: circles are drawn in parts. What
/// comes first stays first.
[[nodiscard]] std::vector<Piece> whole_arcs(const std::vector<Piece>& pieces);

}  // namespace obvid::exchange
