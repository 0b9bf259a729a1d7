// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "find_primitives.h"

namespace obvid::fairing_detail {

/// Where two circles or lines come nearest to touching each other with one heading.
struct TangentPlace {
  double on_first = 0.0;   ///< arc length from the anchor of the first
  double on_second = 0.0;  ///< and of the second
  double gap = 0.0;        ///< between both places, units
};

/// Nothing for two lines or circles of one size, whose headings agree everywhere or nowhere.
[[nodiscard]] std::optional<TangentPlace> tangent_place(const Primitive& a, const Primitive& b);

/// Arc length along a primitive's circle or line from its anchor to the foot of a point, within
/// half a turn.
[[nodiscard]] double foot_on(const Primitive& p, Vec2 point);

/// Length of the clothoid between two curvatures that keeps their circles `shift` apart.
[[nodiscard]] double transition_length(double kappa0, double kappa1, double shift);

}  // namespace obvid::fairing_detail
