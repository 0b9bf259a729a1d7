// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/end_curvatures.h"

#include "fit/parts.h"
#include "obvid/curve/internal/end_curvatures.h"

namespace obvid {

std::vector<EndCurvatures> end_curvatures(const Contour& contour) {
  std::vector<EndCurvatures> out;
  for (const pipeline_detail::Part& part : pipeline_detail::parts_of(contour)) {
    const Joint& before = contour.joints[part.first_piece];
    const Joint& behind = contour.joints[(part.last_piece + 1) % contour.joints.size()];
    EndCurvatures& row = out.emplace_back();
    const bool from_joint = part.t0 == 0.0 && is_station(before);
    const bool to_joint = part.t1 == 1.0 && is_station(behind);
    if (from_joint && to_joint) row.pieces = part.last_piece - part.first_piece + 1;
    row.start = from_joint ? before.leaving.value_or(before.element).kappa
                           : accurate_curvature(contour.pieces[part.first_piece], part.t0);
    row.end = to_joint ? behind.element.kappa
                       : accurate_curvature(contour.pieces[part.last_piece], part.t1);
  }
  return out;
}

}  // namespace obvid
