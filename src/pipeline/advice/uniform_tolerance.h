// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/pipeline/fit.h"

namespace obvid::pipeline_detail {

/// The job with a tolerance of the same size for every point; a point's own one stays where it is
/// larger.
[[nodiscard]] Result<Fit> fit_within(const PointSeries& series, FitJob job, double tolerance,
                                     Watch& watch);

/// The job with its automatic choices made: larger tolerances do not close a series that is open
/// without them.
[[nodiscard]] FitJob with_closing(const PointSeries& series, FitJob job);

/// Moves up to here are lost in the rounding of the coordinates as doubles.
[[nodiscard]] double coordinate_rounding(const PointSeries& series);

/// Rounded up to three significant digits: what is printed is what was tried.
[[nodiscard]] double printable(double tolerance);

}  // namespace obvid::pipeline_detail
