// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/core/result.h"
#include "obvid/curve/contour.h"
#include "obvid/series/point_series.h"

namespace obvid {

/// One segment of the region in which every monotone curve with the given tangents lies
/// (the tables of 000_...). Lengths in units, radii signed like the curvature.
struct RegionRow {
  double chord = 0.0;
  double theta_start = 0.0;  ///< heading at the first point, rad
  double theta_end = 0.0;
  double to_apex = 0.0;    ///< |i,T|: from point i to the meeting of both tangents
  double from_apex = 0.0;  ///< |T,i+1|
  double kappa_start_low = 0.0, kappa_start_high = 0.0;  ///< range of the curvature at point i
  double kappa_end_low = 0.0, kappa_end_high = 0.0;
  double lower_height = 0.0;  ///< of the lower boundary above the middle of the chord
  double width = 0.0;         ///< between both boundaries over the middle of the chord
};

/// Region per segment from the points and the tangents that the engine assigns.
struct RegionTable {
  std::vector<RegionRow> rows;
  std::vector<Element> elements;
};

[[nodiscard]] Result<RegionTable> region_table(const PointSeries& series);

}  // namespace obvid
