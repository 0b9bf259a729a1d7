// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// A warning about the part of a contour that runs farthest from both of its points, when it runs
/// farther than the points reach from their middle to both sides: where so much is left open, the
/// curve is a guess. `given` holds for each point whether the user fixed its heading or curvature:
/// parts beside it do what was asked for. Cancelled, it is worth nothing. Invariant under motions
/// and scaling. Cost O(pieces).
[[nodiscard]] std::optional<std::string> warn_of_excursion(const Contour& contour,
                                                           const std::vector<bool>& given,
                                                           Watch& watch);

/// A warning about a contour that crosses itself more often than the chords between its points do.
/// Both are counted, not proved (`count_crossings`). Cost O(points log points) where it crosses.
[[nodiscard]] std::optional<std::string> warn_of_crossings(const Contour& contour,
                                                           const Certificate& certificate);

}  // namespace obvid::pipeline_detail
