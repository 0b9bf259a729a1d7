// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/cutting/cutting.h"

namespace obvid {

/// The border of what a round tool takes away along the moves that cut (kCut): parallels on both
/// sides, round around corners that turn away and at ends, without what the tool takes on another
/// part of its way. Lines and arcs; cubics are taken as chords within `within` of them. For
/// pictures: where it ends inside of the cut is found to a tenth of a thousandth of the radius; no
/// piece is shorter than half of `within`, ends that belong together are one place, and what printed
/// digits made of one line or circle is one piece (a circle: an arc that ends where it starts).
[[nodiscard]] std::vector<Piece> edge_of_cut(const std::vector<CutMove>& moves, double radius,
                                             double within);

}  // namespace obvid
