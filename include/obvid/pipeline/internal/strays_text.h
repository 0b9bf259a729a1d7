// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace obvid::pipeline_detail {

/// "points 21, 71 lie off the curve of their neighbours: --drop-outliers leaves them out".
/// `numbers`: of the points, from 1, as the user counts; not empty.
[[nodiscard]] std::string strays_text(const std::vector<std::size_t>& numbers);

}  // namespace obvid::pipeline_detail
