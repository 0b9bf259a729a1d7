// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/core/result.h"
#include "obvid/pipeline/region_table.h"

namespace obvid::pipeline_detail {

/// The construction over all segments of a part, section after section between corners; around a
/// loop it comes back with the curvature that it began with, but for clothoids and arcs, which step
/// anyway, and ellipses, whose curvatures the tangents decide. At an inflection parabolas and
/// ellipses step in curvature. All but clothoids and splines need regions. Errors: E401 where a
/// segment has none, or with these headings no radii do; E502 parabolas where the curvature hardly
/// changes; E203 order of fixation 1 with given radii. `fixation`: of parabolas, as RegionJob has
/// it.
[[nodiscard]] Result<ConstructionTable> construct(const RegionPart& part, Construction which,
                                                  std::optional<int> fixation = {});

/// The carrier that a contour of these curves has.
[[nodiscard]] Carrier carrier_of(Construction which);

}  // namespace obvid::pipeline_detail
