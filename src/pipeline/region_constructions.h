// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/core/result.h"
#include "obvid/pipeline/region_table.h"

namespace obvid::pipeline_detail {

/// The construction over all segments of a part that have a region (clothoids: over all).
/// Errors: E401 where a segment has none, or no triangle of tangents; E203 closed series of
/// ellipses, which come back with another curvature; E502 parabolas where the curvature hardly
/// changes; E401, E203 order of fixation 1 where the triangles leave none.
/// `fixation`: of parabolas, as RegionJob has it.
[[nodiscard]] Result<ConstructionTable> construct(const RegionPart& part, Construction which,
                                                  std::optional<int> fixation = {});

/// The carrier that a contour of these curves has.
[[nodiscard]] Carrier carrier_of(Construction which);

}  // namespace obvid::pipeline_detail
