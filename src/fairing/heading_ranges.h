// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tube.h"

namespace obvid::fairing_detail {

/// Gives every node the headings that its neighbourhood asks for: those of the circles through
/// three neighbouring nodes at x that pass it, and once more their width to both sides
/// (docs/methods/fairing.md, section 3). Without them a link over a long chord could swing out as
/// far as it likes, for the sake of a vertex less.
void set_heading_ranges(Tube& tube, const State& x);

}  // namespace obvid::fairing_detail
