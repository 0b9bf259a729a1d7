// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/run_context.h"
#include "obvid/exchange/drawing.h"
#include "obvid/mesh/plane_row.h"

namespace obvid::pipeline_detail {

/// Every chain of edges in which the planes cut the mesh, as a series of points of the plane's own
/// coordinates: "z=12", of several chains of a plane "z=12/1" and so on, longest first. Closed ones
/// end at their first point. Which planes miss the mesh a warning says.
/// Errors: E311 no planes, or none of them meets it; those of `parse_mesh` and `cut_mesh`; E103.
[[nodiscard]] Result<Drawing> sections_of_mesh(std::string_view text, const std::string& path,
                                               const std::vector<PlaneRow>& planes,
                                               const RunContext& run);

}  // namespace obvid::pipeline_detail
