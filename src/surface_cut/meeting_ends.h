// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "obvid/geom/vec3.h"

namespace obvid {

/// Pairs of ends that are at most `near` apart and may meet, the nearest first; each end is in one
/// pair at the most. `may_meet` is asked of two ends that are as near as that, the smaller number
/// first.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> meeting_ends(
    std::vector<std::size_t> ends, double near, const std::function<Vec3(std::size_t)>& place,
    const std::function<bool(std::size_t, std::size_t)>& may_meet);

}  // namespace obvid
