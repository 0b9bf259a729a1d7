// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "simulation.h"

namespace obvid::toolpath {

/// Reads the text of a program as a controller does and simulates it against the surface itself.
/// `scale`: machine units in a unit of the part. Errors: E101 a text that controllers do not
/// understand.
[[nodiscard]] Result<SimulationReport> check_program(const Part& part, const SurfaceCells& cells,
                                                     LargeList<Nearest>& reach,
                                                     const Leftover* left, const std::string& text,
                                                     double scale, const ToolpathOptions& options,
                                                     const RunContext& run);

}  // namespace obvid::toolpath
