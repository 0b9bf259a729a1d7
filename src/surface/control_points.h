// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"

namespace obvid {

/// Numbers of control points and weights, finite, weights > 0.
[[nodiscard]] Result<void> check_points(const std::vector<Vec3>& points,
                                        const std::vector<double>& weights, std::size_t wanted);

}  // namespace obvid
