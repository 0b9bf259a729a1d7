// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "monotone_parts.h"
#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"

namespace obvid {

/// What the ends of the pieces say: gaps, jumps of curvature, inflections.
struct JointSurvey {
  JointGaps gaps;
  bool within_bounds = true;
  std::string reason;             ///< first gap beyond its bound
  std::vector<std::int8_t> jump;  ///< sign of the curvature's jump at the start of each piece
  int inflections = 0;
  int corners = 0;
  int curvature_steps = 0;
};

/// `parts`: for pieces with vertices the parts of them whose curvature is monotone.
[[nodiscard]] JointSurvey survey_joints(const Contour& contour, const MonotoneParts& parts = {});

/// There are points, no two neighbours the same; joints stand on them in their order, around the
/// end of the list in a closed contour. Without tolerances every point is the source of one joint,
/// which stands exactly on it. Empty when so, else the first that is not.
[[nodiscard]] std::string missed_point(const Contour& contour);

}  // namespace obvid
