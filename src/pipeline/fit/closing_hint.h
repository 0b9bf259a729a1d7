// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/units.h"
#include "obvid/geom/vec2.h"

namespace obvid::pipeline_detail {

/// A sentence about an open series that looks like an outline which was left open: its ends are as
/// near as neighbours, or as a fortieth of the length, and the curve goes on over the gap, or
/// around a tip on one side of it (docs/methods/series.md). At a trailing edge it turns back
/// instead. Nothing of others.
[[nodiscard]] std::optional<std::string> hint_at_closing(const std::vector<Vec2>& points,
                                                         const Units& units);

}  // namespace obvid::pipeline_detail
