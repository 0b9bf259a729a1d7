// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/fairing/internal/fairing.h"

namespace obvid::pipeline_detail {

/// The lines and arcs of `fit_alignment` where the points mean nothing else, one behind the other:
/// they leave the points their scatter and no more. Else nothing, and nothing where the search
/// takes too long. `scatter`: of more points, where these are too few to know theirs.
[[nodiscard]] std::vector<MeantPiece> aligned_lines(const MeasuredSeries& series,
                                                    std::optional<double> scatter, Watch& watch);

}  // namespace obvid::pipeline_detail
