// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/pipeline/analyse.h"
#include "text.h"

namespace obvid {

/// What is told of all points together.
[[nodiscard]] Facts series_facts(const PointSeries& series, const Analysis& analysis);

/// What the points of a series alone say: tables and figures.
[[nodiscard]] std::string series_report_text(const PointSeries& series, const Analysis& analysis);

}  // namespace obvid
