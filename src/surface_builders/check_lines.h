// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "obvid/surface_builders/internal/check.h"

namespace obvid {

/// Curvature along the lines v = const of a surface. Error: E103.
[[nodiscard]] Result<LineReport> check_lines(const NurbsSurface& surface, std::size_t lines,
                                             const RunContext& run);

}  // namespace obvid
