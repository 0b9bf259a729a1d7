// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/io/stored_contour.h"

namespace obvid::pipeline_detail {

/// How many headings, curvatures and corners were given, and the largest miss of each: the pieces
/// on both sides of a point against what was given there. Arcs have a curvature of their own on
/// either side: one between both keeps what was given.
[[nodiscard]] GivenReport measure_given(const Contour& contour);

/// Error E406, naming the point, when the contour misses a given heading or curvature by more than
/// what counts as continuous.
[[nodiscard]] Result<void> keeps_given(const Contour& contour);

}  // namespace obvid::pipeline_detail
