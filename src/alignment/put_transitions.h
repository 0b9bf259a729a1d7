// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "chain_on_points.h"

namespace obvid::alignment {

/// Runs of elements between constant curvatures become one transition of that kind: as many at once
/// as the points allow, because where a search with clothoids needs several, and short arcs between
/// them, one of another kind may do.
[[nodiscard]] Result<void> put_transitions(ChainOnPoints& chain, Transition law,
                                           const RunContext& run);

/// Puts a transition into each joint with a step of the curvature. E502 where none has room.
[[nodiscard]] Result<void> take_steps_away(ChainOnPoints& chain, Transition law,
                                           const RunContext& run);

}  // namespace obvid::alignment
