// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// Part of a contour between two neighbouring stations (docs/claims.md): from parameter t0 of its
/// first piece to t1 of its last one.
struct Part {
  std::size_t from = 0;  ///< point of the series at its start; behind a corner between two
  std::size_t to = 0;    ///< and at its end
  std::size_t first_piece = 0;
  std::size_t last_piece = 0;
  double t0 = 0.0;
  double t1 = 1.0;
};

/// Parts in order along the whole contour. Stations are the joints that stand on points, and
/// corners between two: a part ends there as at the point before and begins as at the one behind.
/// Carriers whose joints do not (`CarrierInfo::between_joints`) have one at the place nearest to
/// each point too, as far as these places follow each other in the order of the points. Cancelled:
/// some of them.
[[nodiscard]] std::vector<Part> parts_of(const Contour& contour, Watch* watch = nullptr);

}  // namespace obvid::pipeline_detail
