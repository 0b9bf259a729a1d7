// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "chain_on_points.h"

namespace obvid::alignment {

/// Neighbours become one, or an element is left out, wherever that passes the points: the search
/// keeps some of the ways to a place only, and its joints are at places. `constant`: curvature
/// along each element.
[[nodiscard]] Result<void> take_fewer_elements(ChainOnPoints& chain, bool constant,
                                               const RunContext& run);

/// Joins the end of an open chain to its start: elements around the seam, few of them and then
/// more, are fitted between the poses of those beside them; where none will do, with one element
/// more. E401 where they do not join.
[[nodiscard]] Result<void> close_loop(ChainOnPoints& chain, bool constant, const RunContext& run);

}  // namespace obvid::alignment
