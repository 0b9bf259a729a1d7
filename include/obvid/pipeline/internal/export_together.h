// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/titled_contour.h"

namespace obvid {

/// Whether one file of a format can hold several contours with these choices. Errors: E203 where it
/// holds one, with the formats that hold several, or where an asked plot is of one; E310.
[[nodiscard]] Result<void> can_export_together(FileFormat format, const ExportOptions& options);

/// Several contours in one file, in the form that `export_contour` gives each of them: DXF on their
/// layers, SVG as paths of a drawing in true scale, groups being layers, STEP, IGES and BREP as
/// curves beside each other. A contour without a layer has one that is called by its id, else by
/// its name. What is said of the units is said once. Errors: those of `can_export_together` and of
/// `export_contour`; E203 contours of different units.
[[nodiscard]] Result<Exported> export_together(const std::vector<TitledContour>& contours,
                                               FileFormat format, const ExportOptions& options,
                                               const RunContext& run = {});

}  // namespace obvid
