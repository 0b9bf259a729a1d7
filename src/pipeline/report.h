// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"
#include "obvid/io/stored_contour.h"
#include "obvid/series/analysis.h"

namespace obvid::pipeline_detail {

/// Every figure of the report that follows from the contour and its points alone.
[[nodiscard]] FitReport measure(const Contour& contour, const Analysis& analysis, double tolerance);

/// Default of the tolerance: the seeds' 0.001 mm, near enough, on their series of 280 mm across.
[[nodiscard]] double default_tolerance(const Analysis& analysis);

}  // namespace obvid::pipeline_detail
