// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/contour.h"

namespace obvid {

/// Number of crossings between pieces of different runs. Pieces of one run, proved monotone, are
/// nested within each other's osculating circles and cannot meet. Counted down to 1e-9 of the
/// size, not proved: two parts that touch may count or not.
[[nodiscard]] int count_crossings(const Contour& contour);

}  // namespace obvid
