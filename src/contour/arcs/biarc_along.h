// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "obvid/geom/element.h"
#include "track.h"

namespace obvid::arcs {

/// Where two pairs of arcs meet: a point of the contour, and a heading near the contour's.
struct Node {
  double s = 0.0;
  Vec2 point;
  double theta = 0.0;
};

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
