// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// Joints with a common curvature at which its slope, d kappa/ds, steps by more than
/// `kContinuousSlope` of the largest slope of the two pieces, whatever the contour says of its
/// continuity. The contour is one of which something can be proved (`out_of_range`,
/// `joint_without_curvature`). Cost O(n).
[[nodiscard]] std::vector<std::size_t> joints_with_loose_slopes(Contour contour);

}  // namespace obvid
