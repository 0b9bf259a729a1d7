// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "bordered_system.h"
#include "tube.h"

namespace obvid::fairing_detail {

/// Where a link begins or ends.
struct NodeEnd {
  Vec2 position, tangent;
  double kappa = 0.0;
};

/// A node with its unknowns: where links arrive and where they leave. They differ at a primitive,
/// an exact arc or line of fixed length around its anchor.
struct PlacedNode {
  Vec2 anchor, tangent;  ///< of the anchor
  NodeEnd in, out;
};

/// Derivatives of an end by the unknowns of its node.
struct EndJet {
  std::array<Vec2, kPerNode> position;
  Vec3 theta{}, kappa{};
};

[[nodiscard]] PlacedNode place(const TubeNode& node, const double* unknowns);
/// `s` is the arc length from the anchor to the end: -before, after, or 0.
[[nodiscard]] EndJet end_jet(const TubeNode& node, const PlacedNode& placed, double s);

/// Signed distance of a point from the circle of a primitive, left of it positive, with derivatives
/// by the node's unknowns.
struct CircleDistance {
  double value = 0.0;
  Vec3 slope{};
};
[[nodiscard]] CircleDistance circle_distance(const TubeNode& node, const PlacedNode& placed,
                                             Vec2 point);

}  // namespace obvid::fairing_detail
