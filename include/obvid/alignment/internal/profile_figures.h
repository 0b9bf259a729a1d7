// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/core/error.h"

namespace obvid {

/// What an element between two grades is.
[[nodiscard]] ProfileKind kind_between(double grade0, double grade1);

/// Height at the end of an element: that of its start, its length and its grades say where.
[[nodiscard]] double end_height(const ProfileElement& element, ProfileCurves curves);

/// Radius of a vertical curve with these grades at its ends and this length along the station, with
/// its sign: of a parabola that at its vertex. Infinite where both grades are the same.
[[nodiscard]] double radius_between(double grade0, double grade1, double length,
                                    ProfileCurves curves);

/// The first figure of a profile that others of the same element contradict: its kind, or its
/// radius. E503, `where`: "elements/2/radius".
[[nodiscard]] std::optional<Error> contradiction_in(const VerticalProfile& profile);

/// Figures of a profile that may be wrong by a little without others showing it, as elements meet
/// roughly only: "elements/*/station (only that ...)".
[[nodiscard]] std::vector<std::string> loose_figures(const VerticalProfile& profile);

}  // namespace obvid
