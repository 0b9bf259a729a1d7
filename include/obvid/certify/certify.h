// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant, an object is used by one thread at a time: docs/threads.md

#include <cstddef>
#include <memory>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/core/internal/watch.h"
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
/// The same as part of some longer work; when that is cancelled, it is no certificate.
[[nodiscard]] Certificate certify(const Contour& contour, Watch& watch);

/// What proofs found out about the single pieces of a contour, for contours that change in parts.
/// A moved-from one can only be assigned to.
class PieceMemory {
 public:
  PieceMemory();
  ~PieceMemory();
  PieceMemory(PieceMemory&&) noexcept;
  PieceMemory& operator=(PieceMemory&&) noexcept;

  /// `count` other pieces stand now where first..end - 1 were: nothing is known of them.
  void replace(std::size_t first, std::size_t end, std::size_t count);
  /// Nothing is known of any piece.
  void clear();

  struct Pieces;

 private:
  friend Certificate certify(const Contour& contour, PieceMemory& memory, Watch& watch);
  std::unique_ptr<Pieces> pieces_;
};

/// The same certificate, bit for bit, as that without a memory, which must be of this contour: its
/// pieces were told by `replace` wherever they changed. Pieces that it does not know are examined;
/// joints, points and runs always are. It knows all pieces afterwards.
[[nodiscard]] Certificate certify(const Contour& contour, PieceMemory& memory, Watch& watch);

/// Proved upper bound of every input point's distance from the contour, units: the distance to some
/// point of the contour near it, with the rounding of its evaluation. Infinite without pieces.
/// Not guaranteed to be the smallest distance. Cost O(n) for points in the order of the contour.
[[nodiscard]] std::vector<double> point_distances(const Contour& contour);
[[nodiscard]] std::vector<double> point_distances(const Contour& contour, Watch& watch);

/// Points with tolerances that the contour, followed from its start, does not pass within them
/// after the points before; empty when it passes all in order. Cost as above.
[[nodiscard]] std::vector<std::size_t> points_out_of_order(const Contour& contour, Watch& watch);

}  // namespace obvid
