// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "four_points.h"

namespace obvid::series_detail {

/// For every point the last one up to which the series can be passed in order, within the reaches,
/// by a curve whose headings keep within one right angle. A right angle begins at any of 32
/// directions, counted from that of the whole series. O(n) time and memory.
[[nodiscard]] std::vector<std::size_t> right_angle_stretches(const std::vector<Disc>& discs);

}  // namespace obvid::series_detail
