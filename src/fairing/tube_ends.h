// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "tube.h"

namespace obvid::fairing_detail {

/// Noise may have moved other points beyond the first or last one of an open series. The end node
/// then moves back along its tangent, as far as its own reach and those of the others share the
/// way, and offsets keep to what is left of its reach; points that still lie beyond the end keep to
/// what is left of theirs. Call with the reaches as measured.
void make_room_at_ends(Tube& tube);

}  // namespace obvid::fairing_detail
