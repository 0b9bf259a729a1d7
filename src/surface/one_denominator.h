// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "obvid/surface/space_curve.h"

namespace obvid {

/// Two curves over [0, 1] as they are, but with the same knots and the same weights: the products
/// of both. Degrees add. Nothing where the sum is above `kMaxNurbsDegree`.
[[nodiscard]] std::optional<std::array<SpaceCurve, 2>> with_one_denominator(SpaceCurve first,
                                                                            SpaceCurve second);

}  // namespace obvid
