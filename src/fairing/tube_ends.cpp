// SPDX-License-Identifier: Apache-2.0
#include "tube_ends.h"

#include <algorithm>
#include <cmath>

namespace obvid::fairing_detail {
namespace {

/// Of a reach, the most that a move along the tangent may use up.
constexpr double kMostAlong = 0.95;

double left_across(double reach, double along) {
  const double part = std::min(along / reach, kMostAlong);
  return reach * std::sqrt(1.0 - part * part);
}

/// `outward` is the unit tangent that leads out of the series at this end.
void make_room(TubeNode& node, Vec2 outward, TubeRow* first, TubeRow* last) {
  if (node.is_primitive() || !(node.reach > 0.0)) return;
  double along = 0.0;
  for (const TubeRow* row = first; row != last; ++row) {
    const double beyond = dot(outward, row->point - node.point);
    along = std::max(along, beyond * node.reach / (node.reach + row->reach));
  }
  if (!(along > 0.0)) return;
  along = std::min(along, kMostAlong * node.reach);
  node.point = node.point + along * outward;
  node.reach = left_across(node.reach, along);
  for (TubeRow* row = first; row != last; ++row) {
    const double beyond = dot(outward, row->point - node.point);
    if (beyond > 0.0) row->reach = left_across(row->reach, beyond);
  }
}

}  // namespace

void make_room_at_ends(Tube& tube) {
  if (tube.closed || tube.links() == 0) return;
  TubeRow* const rows = tube.rows.data();
  const std::size_t links = tube.links();
  TubeNode &front = tube.nodes.front(), &back = tube.nodes.back();
  make_room(front, -unit_at(front.theta), rows, rows + tube.first_row[1]);
  make_room(back, unit_at(back.theta), rows + tube.first_row[links - 1],
            rows + tube.first_row[links]);
}

}  // namespace obvid::fairing_detail
