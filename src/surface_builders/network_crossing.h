// SPDX-License-Identifier: Apache-2.0
// Nearest points of two curves in space.
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/geom/internal/box.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

[[nodiscard]] double distance_between(const Box3& a, const Box3& b);

/// A curve with boxes around its pieces, and around ever larger runs of pieces.
class BoxedCurve {
 public:
  explicit BoxedCurve(const SpaceCurve& curve);

  struct Node {
    Box3 box;
    std::size_t begin = 0, end = 0;   ///< pieces
    std::size_t left = 0, right = 0;  ///< children; both 0: one piece
  };
  [[nodiscard]] const SpaceCurve& curve() const { return curve_; }
  [[nodiscard]] const Node& node(std::size_t i) const { return nodes_[i]; }
  [[nodiscard]] std::size_t root() const { return nodes_.size() - 1; }
  /// Parameter in the middle of a piece.
  [[nodiscard]] double middle(std::size_t piece) const {
    return (ends_[piece] + ends_[piece + 1]) / 2.0;
  }

 private:
  std::size_t build(const std::vector<Box3>& boxes, std::size_t begin, std::size_t end);

  SpaceCurve curve_;
  std::vector<double> ends_;
  std::vector<Node> nodes_;
};

/// Parameters on both curves and the distance there.
struct Crossing {
  double s = 0.0, t = 0.0;
  double distance = 0.0;
};

/// Nearest points: boxes exclude pieces, from the others Newton's method goes down.
[[nodiscard]] Crossing nearest_points(const BoxedCurve& a, const BoxedCurve& b);

}  // namespace obvid
