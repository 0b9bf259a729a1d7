// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/picture/internal/longitudinals_svg.h"
#include "obvid/pipeline/surface_export.h"

namespace obvid::pipeline_detail {

/// Ten lines u = const of all patches together, one or more of each, at even parts of its domain,
/// each at 24 places of a span or more. Error: E103.
[[nodiscard]] Result<LongitudinalsPicture> longitudinals_of(const SurfaceModel& model,
                                                            const ShownLongitudinals& shown,
                                                            const RunContext& run);

}  // namespace obvid::pipeline_detail
