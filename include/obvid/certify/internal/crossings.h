// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "obvid/curve/contour.h"

namespace obvid {

/// Number of crossings between pieces of different runs. Pieces of one run, proved monotone, are
/// nested within each other's osculating circles and cannot meet; those of a run with a piece that
/// is not (`turning`: their indices) may meet each other, and themselves. Counted down to 1e-9 of
/// the size, not proved: two parts that touch may count or not.
[[nodiscard]] int count_crossings(const Contour& contour,
                                  std::span<const std::size_t> turning = {});

/// The same of the chords from point to point, and back to the first if it is closed.
[[nodiscard]] int count_crossings_of_chords(std::span<const Vec2> points, bool closed);

}  // namespace obvid
