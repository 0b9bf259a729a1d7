// SPDX-License-Identifier: Apache-2.0
#include "move_list.h"

#include <utility>

namespace obvid::toolpath {

double length_of(const std::vector<Vec3>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += norm(points[i] - points[i - 1]);
  return sum;
}

void MoveList::add(ToolMove kind, std::vector<Vec3> points, PassPlane plane) {
  at_ = points.back();
  begun_ = true;
  if (kind == ToolMove::kPass) ++out_.report.passes;
  out_.moves.push_back({kind, plane, std::move(points)});
}

void MoveList::enter(Vec3 start) {
  const Vec3 above{start.x, start.y, out_.report.safe_z};
  add(ToolMove::kRapid, begun_ ? std::vector<Vec3>{at_, above} : std::vector<Vec3>{above});
  add(ToolMove::kPlunge, {above, start});
}

void MoveList::leave() {
  if (begun_) add(ToolMove::kRapid, {at_, {at_.x, at_.y, out_.report.safe_z}});
}

}  // namespace obvid::toolpath
