// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "obvid/geom/element.h"
#include "track.h"

namespace obvid::arcs {

/// Where two pairs of arcs meet: a point of the contour or near it, and a heading near the
/// contour's.
struct Node {
  double s = 0.0;
  Vec2 point;
  double theta = 0.0;
  double ratio = 1.0;  ///< of the pair that ends here: length of its second leg over the first
};

/// An arc or line as what distances from it need.
struct Circle {
  Vec2 start;
  Vec2 tangent;
  double kappa = 0.0;
};

/// Distance of a point from a whole circle, to the left of its direction positive.
[[nodiscard]] double signed_distance(const Circle& circle, Vec2 p);

/// Two arcs as circles; `joint` is where they meet.
struct CirclePair {
  Circle first, second;
};
[[nodiscard]] CirclePair circles_between(const Node& a, const Node& b);

/// Two arcs between nodes that share a tangent.
[[nodiscard]] std::array<Piece, 2> arcs_between(const Node& a, const Node& b);

/// Curvatures of such arcs.
struct PairCurvatures {
  double first = 0.0;
  double second = 0.0;
};

/// The two arcs from `a` to `b`, if they stay within `tolerance` of the contour between them. The
/// contour may turn by no more than a fixed angle there.
[[nodiscard]] std::optional<PairCurvatures> pair_along(const Track& track, const Node& a,
                                                       const Node& b, double tolerance);

}  // namespace obvid::arcs
