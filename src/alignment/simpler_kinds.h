// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "chain_on_points.h"

namespace obvid::alignment {

/// Clothoids become arcs, arcs lines, and joints lose their step, where the points allow it: first
/// what their scatter leaves open, then what the tolerance alone does. Whether one did.
[[nodiscard]] Result<bool> take_simpler_kinds(ChainOnPoints& chain, bool constant,
                                              const RunContext& run);

}  // namespace obvid::alignment
