// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/curve/contour.h"

namespace obvid {

/// Signed curvature of a contour where a part between two neighbouring stations begins and ends,
/// 1/unit, positive to the left.
struct EndCurvatures {
  double start = 0.0;
  double end = 0.0;
  std::size_t pieces = 0;  ///< of the part, where joints are its ends; else 0
};

/// Of every row of the report of a contour (docs/claims.md), in their order: at a joint that stands
/// on a point, or is a corner between two, that of its element (behind it and before it where these are two), elsewhere that of
/// the contour at the place that stands for the point. Cost: pieces and points once.
[[nodiscard]] std::vector<EndCurvatures> end_curvatures(const Contour& contour);

}  // namespace obvid
