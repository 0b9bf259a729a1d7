// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "box.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// Proved upper bound of a point's distance from a piece: the distance to some point of it, usually
/// the nearest, with all roundings. Infinite for a piece without finite numbers.
[[nodiscard]] double distance_bound(const Piece& piece, Vec2 p);

/// The same for a point that is known to one rounding of its coordinates; 0 when both are the same.
[[nodiscard]] double distance_bound(Vec2 a, Vec2 b);

/// A tree of boxes over pieces in their order, to find the nearest ones.
class PieceTree {
 public:
  explicit PieceTree(const std::vector<Piece>& pieces);

  /// Lowers `best` to the distance of `p` from the pieces first to last, where that is smaller.
  void improve(Vec2 p, std::size_t first, std::size_t last, double& best);

 private:
  struct Node {
    std::size_t id, first, width;  ///< pieces [first, first + width)
  };
  struct Query {
    Vec2 p;
    std::size_t first, last;
    double& best;
  };

  void visit(const Node& node, const Query& query);

  const std::vector<Piece>& pieces_;
  std::size_t leaves_ = 0;
  std::vector<Box> boxes_;
  std::size_t work_left_ = 0;
};

}  // namespace obvid
