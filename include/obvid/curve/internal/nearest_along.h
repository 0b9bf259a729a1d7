// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid {

/// The place of a path nearest to points that move along it. The next place is looked for from the
/// last one on, so that a point costs a step or two of Newton's method; where a path passes twice
/// near a point it is the pass alongside that counts. Where the path turns back sharply the nearest
/// place of one leg is left behind while the points go on along the other: a distance that is 1 %
/// larger than all before is looked for along the whole path, in time linear in it. A distance is
/// never below that of the nearest point of the path. The path must live as long as this.
class NearestAlong {
 public:
  struct Place {
    std::size_t piece = 0;
    double t = 0.0;         ///< on that piece
    double distance = 0.0;  ///< of the point from it
  };

  explicit NearestAlong(std::span<const Piece> path);

  /// The place nearest to `p`. Neighbouring pieces are tried when it is farther than `known`.
  Place next(Vec2 p, double known = 0.0);

 private:
  double distance(Vec2 p, double known);
  void look_everywhere(Vec2 p, double& here);
  double settle(std::size_t piece, double& t, Vec2 p) const;
  bool step_to(std::size_t piece, double t, Vec2 p, double& here);
  bool improve(std::size_t piece, double t, Vec2 p, double& here);

  std::span<const Piece> path_;
  std::vector<Vec2> places_;   ///< some of each piece
  std::vector<double> apart_;  ///< farthest neighbours among the places and ends of each piece
  double farthest_ = 0.0;      ///< of the nearest points of all
  std::size_t at_ = 0;
  double t_ = 0.0;
};

}  // namespace obvid
