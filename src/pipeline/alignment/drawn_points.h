// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/series/point_series.h"

namespace obvid::pipeline_detail {

/// A series whose pieces of a drawing are points as well: joints alone say nothing about what is
/// drawn between them. At even distances, so near each other that chords are within half of the
/// tolerance of every piece; where these are too many, as near as that many can be, with a warning.
/// A series without such pieces as it is.
[[nodiscard]] PointSeries with_drawn_points(const PointSeries& series, double tolerance,
                                            std::vector<std::string>& remarks,
                                            std::vector<std::string>& warnings);

/// E203: a drawn curve has no scatter and no printed digits that a tolerance could be told from.
[[nodiscard]] Result<void> drawn_curve_has_tolerance(const PointSeries& series, bool given);

}  // namespace obvid::pipeline_detail
