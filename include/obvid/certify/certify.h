// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// Proves how the signed curvature of one piece changes as t runs from 0 to 1.
///
/// Guarantee: `kIncreasing` and `kDecreasing` hold strictly on the open interval (0, 1) for the
/// piece exactly as its doubles stand; `kHasVertex` holds between t0 and t1. `kUndecided` means
/// that no proof was found (a weight function that is not positive, a cusp, or a double zero of
/// the curvature's derivative), never that rounding got in the way: the last resort is exact.
/// Cost: about 0.5 us for a quartic; some 20 times that where doubles cannot decide.
[[nodiscard]] PieceProof prove_piece(const Piece& piece);

/// Proves every claim of a contour from its own numbers (docs/methods/certify.md). Nothing is
/// proved of numbers that `out_of_range` names, nor while the processor does not round to the
/// nearest. `self_intersections` are counted, not proved, and do not make a contour unproved. Cost
/// O(n log n), about a microsecond per piece.
[[nodiscard]] Certificate certify(const Contour& contour);

/// Proved upper bound of every input point's distance from the contour, units: the distance to some
/// point of the contour near it, with the rounding of its evaluation. Infinite without pieces.
/// Not guaranteed to be the smallest distance. Cost O(n) for points in the order of the contour.
[[nodiscard]] std::vector<double> point_distances(const Contour& contour);

}  // namespace obvid
