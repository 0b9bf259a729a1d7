// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/geom/internal/value_range.h"
#include "obvid/report/stored_contour.h"

namespace obvid::pipeline_detail {

/// The end that a value has passed by more than what counts as continuous; nothing inside the
/// range. Headings count modulo a full turn.
[[nodiscard]] std::optional<double> passed_heading(const ValueRange& thetas, double theta);
[[nodiscard]] std::optional<double> passed_end(const ValueRange& kappas, double kappa);

/// How many headings, curvatures and corners were given, and the largest miss of each: the pieces
/// on both sides of a point against what was given there. Arcs have a curvature of their own on
/// either side: one between both keeps what was given.
[[nodiscard]] GivenReport measure_given(const Contour& contour);

/// Where the contour passes an end of a given range by more than what counts as continuous: the
/// points, each with the end.
[[nodiscard]] std::vector<GivenDatum> passed_ends(const Contour& contour);

/// Error E406, naming the point, when the contour misses a given heading or curvature by more than
/// what counts as continuous.
[[nodiscard]] Result<void> keeps_given(const Contour& contour);

}  // namespace obvid::pipeline_detail
