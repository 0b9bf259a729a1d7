// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "nearest_piece.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// A place of the contour near each point, usually the nearest, or where its joint stands when that
/// is near enough.
[[nodiscard]] std::vector<Nearest> nearest_places(const Contour& contour, Watch& watch);

/// Whether a contour, followed from its start, passes points with tolerances one after the other,
/// each within its tolerance; a closed one from any place on and once around. Empty when so, else
/// the points that it does not pass after those before them. `places` as found above.
[[nodiscard]] std::vector<std::size_t> out_of_order(const Contour& contour,
                                                    const std::vector<Nearest>& places);

/// How far the contour may pass point `i`: its tolerance, and what the coordinates of point and
/// contour do not tell.
[[nodiscard]] double allowed_distance(const Contour& contour, std::size_t i);

}  // namespace obvid
