// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "contour_field.h"
#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "trim_patch.h"

namespace obvid {

/// The lines along which a field is 0 on a surface, found where its sign changes between neighbours
/// on a raster of at least 8 cells in every span and 33 in each direction, 256 at most; with the
/// places over corners of a contour. What is smaller than a cell is missed. Error: E103.
[[nodiscard]] Result<std::vector<CutLine>> field_lines(
    const NurbsSurface& surface, const CuttingField& field,
    const std::vector<ContourField::Corner>& corners, const RunContext& run);

}  // namespace obvid
