// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"
#include "obvid/report/stored_contour.h"

namespace obvid::pipeline_detail {

/// Fills in how far a contour of another carrier is from the spirals and from their regions, as
/// measured at 16 places or more of each piece; every distance is an upper bound.
void measure_against(const Contour& spirals, const Contour& contour, Watch& watch,
                     FitReport& report);

}  // namespace obvid::pipeline_detail
