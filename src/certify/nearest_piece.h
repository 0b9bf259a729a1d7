// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "box.h"
#include "obvid/curve/pieces.h"

namespace obvid {

/// A place of a contour with a proved upper bound of its distance from a point.
struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  std::size_t piece = 0;
  double t = 0.0;
};

/// Proved upper bound of the distance of a point from the piece's point at `t`, with all roundings.
/// Infinite for a piece without finite numbers, or whose inner points are not known well.
[[nodiscard]] double distance_at(const Piece& piece, double t, Vec2 p);

/// The same at some place between `from` and the end of the piece, usually the nearest. The number
/// of the piece is left to the caller.
[[nodiscard]] Nearest nearest_on(const Piece& piece, Vec2 p, double from = 0.0);

/// The same between two points that are known to one rounding of their coordinates; 0 when both are
/// the same.
[[nodiscard]] double distance_bound(Vec2 a, Vec2 b);

/// A tree of boxes over pieces in their order, to find the nearest ones.
class PieceTree {
 public:
  explicit PieceTree(const std::vector<Piece>& pieces);

  /// Moves `best` to the pieces first to last, where those are nearer to `p`.
  void improve(Vec2 p, std::size_t first, std::size_t last, Nearest& best);

 private:
  struct Node {
    std::size_t id, first, width;  ///< pieces [first, first + width)
  };
  struct Query {
    Vec2 p;
    std::size_t first, last;
    Nearest& best;
  };

  void visit(const Node& node, const Query& query);

  const std::vector<Piece>& pieces_;
  std::size_t leaves_ = 0;
  std::vector<Box> boxes_;
  std::size_t work_left_ = 0;
};

}  // namespace obvid
