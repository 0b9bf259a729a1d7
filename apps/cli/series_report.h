// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/series/analysis.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// What the points of a series alone say: tables and figures.
[[nodiscard]] std::string series_report_text(const PointSeries& series, const Analysis& analysis);

}  // namespace obvid
