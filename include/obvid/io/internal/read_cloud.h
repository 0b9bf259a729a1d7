// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <string>
#include <string_view>

#include "obvid/core/result.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

/// Points in no order, and what was assumed of their columns; empty: nothing was.
struct PointCloud {
  SpaceSeries points;
  std::string assumed;
};

/// Rows of numbers: columns named x, y and z; without names the only three, or the first three of
/// more (`assumed`), after a running number where the first column is one. Blank lines mean
/// nothing. Errors: E302 to E306 with line, E310.
[[nodiscard]] Result<PointCloud> parse_cloud(std::string_view text, std::string_view name);

}  // namespace obvid
