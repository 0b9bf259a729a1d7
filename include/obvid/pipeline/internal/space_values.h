// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec3.h"
#include "obvid/pipeline/import.h"
#include "obvid/series/point_series.h"
#include "obvid/surface/point_grid.h"

namespace obvid {

// What users say of points in space, read alike for all front ends.

/// X, Y, Z, or three numbers with commas; empty: nothing. Error: E203.
[[nodiscard]] Result<std::optional<Vec3>> direction_named(const std::string& typed);

/// What a file fixes at its points in space, one entry for each, or nothing. `text`: its content,
/// read as points of the plane of x and y; headings, radii and tolerances there need the direction
/// z. Error: E203.
[[nodiscard]] Result<std::vector<FixedData>> fixed_in_space(const SpaceSeries& series,
                                                            const std::string& text,
                                                            const std::optional<Vec3>& along,
                                                            const std::string& name,
                                                            const ImportOptions& import = {});

}  // namespace obvid
