// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

#include "obvid/curve/pieces.h"

namespace obvid {

/// Largest distance of the middles of equal steps of the parameter from the chords over them,
/// units; once `enough` is exceeded, what was found so far.
[[nodiscard]] double largest_sagitta(const Piece& piece, int steps,
                                     double enough = std::numeric_limits<double>::infinity());

/// Steps for chords within `tolerance` of the piece, by `largest_sagitta`: `fewest`, doubled until
/// they do or are `most`.
[[nodiscard]] int chord_steps(const Piece& piece, double tolerance, int fewest, int most);

}  // namespace obvid
