// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "obvid/pipeline/fit.h"

namespace obvid {

using FigureRows = std::vector<std::pair<std::string, std::string>>;  ///< label, value

/// What is told of a formed contour beside its table, on terminals and pages alike.
[[nodiscard]] FigureRows fit_figures(const Contour& contour, const FitReport& report,
                                     const Certificate& certificate);

/// A length with its unit; NaN as "unknown".
[[nodiscard]] std::string known_length(double value, const std::string& unit, int digits = 4);

/// "3-4"
[[nodiscard]] std::string points_of_segment(const SegmentReport& segment);

/// What stays of a drawing whatever the carrier ("4 lines, 1 arc as drawn"); empty for points.
[[nodiscard]] std::string as_drawn_text(const Contour& contour);

}  // namespace obvid
