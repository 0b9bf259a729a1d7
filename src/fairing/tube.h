// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "obvid/geom/vec2.h"

namespace obvid::fairing_detail {

/// A point through whose neighbourhood the contour is led: unknowns are its offset along `normal`
/// in units of `reach`, its heading minus `theta`, its curvature minus `kappa` times `length`.
struct TubeNode {
  Vec2 point;           ///< as measured, from the tube's origin
  Vec2 normal;          ///< unit
  double reach = 0.0;   ///< largest offset, units; 0: the point stays
  double theta = 0.0;   ///< reference heading, rad
  double kappa = 0.0;   ///< reference curvature, 1/unit
  double length = 1.0;  ///< local scale, units
  double sign = 0.0;    ///< the curvature must keep this sign; 0 = free
  bool fix_theta = false, fix_kappa = false;
  /// The heading keeps between these, rad from `theta`.
  double turn_low = -std::numeric_limits<double>::infinity();
  double turn_high = std::numeric_limits<double>::infinity();
  /// A primitive: the arc or line from `before` ahead of the anchor to `after` behind it, arc
  /// lengths; it passes the points first_on .. last_on - 1 of `Tube::on_primitives`.
  double before = 0.0, after = 0.0;
  /// Of these, how much lies ahead of the first point's foot, and behind the last one's.
  double lead = 0.0, trail = 0.0;
  std::size_t first_on = 0, last_on = 0;

  [[nodiscard]] bool is_primitive() const { return before + after > 0.0; }
  [[nodiscard]] bool bounds_heading() const { return turn_low > -1e300 && turn_high < 1e300; }
};

/// A measured point between two nodes: the contour must pass it within `reach`.
struct TubeRow {
  Vec2 point;
  double reach = 0.0;
};

/// Measured points with their tolerances, as a chain of nodes with rows between them. Link i leads
/// from node i to the next (from the last to the first when closed) and owns the rows
/// first_row[i] .. first_row[i + 1] - 1.
struct Tube {
  Vec2 origin;
  std::vector<TubeNode> nodes;
  std::vector<TubeRow> rows;
  std::vector<std::size_t> first_row;
  std::vector<TubeRow> on_primitives;
  std::vector<double> size;  ///< per link: expected B - A, the unit of its cone
  bool closed = false;

  [[nodiscard]] std::size_t links() const { return closed ? nodes.size() : nodes.size() - 1; }
};

/// Unknowns of all nodes, three each: offset, heading, curvature.
using State = std::vector<double>;

}  // namespace obvid::fairing_detail
