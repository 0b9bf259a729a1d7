// SPDX-License-Identifier: Apache-2.0
// Rotor blades on surfaces of revolution as NASA published rotor 67: after a line with the words
// JM NS NB JLE JTE and one with their numbers, for each surface the axial distance, the arc
// R * THETA of one side, the thickness along it and the radius, each under a title as a scale
// and JM numbers. The blade lies from place JLE to JTE; the others are the duct before and behind.
#pragma once

#include <string_view>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

[[nodiscard]] bool is_on_streamsurfaces(std::string_view text);

/// A section of each surface, x along the axis: the side that is told from JTE to JLE, the other
/// one back. Unit: that of a sentence "dimensions are in ...". Asks between lines. Errors: E103;
/// E304 a surface ends early, E306 another word stands where a number is due, E310 a title, a count
/// or a radius that cannot be.
[[nodiscard]] Result<std::vector<SpaceSeries>> parse_streamsurfaces(std::string_view text,
                                                                    std::string_view name,
                                                                    const RunContext& run = {});

}  // namespace obvid
