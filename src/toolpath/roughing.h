// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "obvid/core/run_context.h"
#include "part.h"

namespace obvid::toolpath {

/// The stock that is given, or the box of the part, wider by the allowance on its sides and on top.
[[nodiscard]] std::array<Vec3, 2> stock_of(const Part& part, const ToolpathOptions& options);

/// Takes the stock off in levels of equal height, each by straight stretches side by side where the
/// cutter, on that level, stays clear of the part and its allowance. Derivation:
/// docs/methods/toolpath.md. Errors: E203 more levels than 20,000; E502 more places than allowed.
[[nodiscard]] Result<void> lay_rough(const Part& part, const ToolpathOptions& options,
                                     const RunContext& run, Toolpath& out);

}  // namespace obvid::toolpath
