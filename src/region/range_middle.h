// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/region/internal/curvature_chains.h"

namespace obvid::region_detail {

/// The middle of a range of radii; of curvatures where a radius is infinite or changes sign.
inline double middle_curvature(const CurvatureRange& range) {
  // open at one end and over zero at the other: between straight and the end that is known
  if (std::isinf(range.low) && std::isfinite(range.high) && range.high > 0.0) {
    return 0.5 * range.high;
  }
  if (std::isinf(range.high) && std::isfinite(range.low) && range.low < 0.0) {
    return 0.5 * range.low;
  }
  if (range.low * range.high > 0.0 || std::isinf(range.low) || std::isinf(range.high)) {
    const double low = 1.0 / range.low, high = 1.0 / range.high;
    if (std::isfinite(low) && std::isfinite(high)) {
      if (low != 0.0 || high != 0.0) return 2.0 / (low + high);
      return 0.0;
    }
    if (std::isinf(range.low)) return range.high > 0.0 ? 0.0 : -1.0;  // all of one sign
    if (std::isinf(range.high)) return range.low < 0.0 ? 0.0 : 1.0;
  }
  return 0.5 * (range.low + range.high);
}

/// The curvature that is wanted; where the range leaves it out, or it lies beside an end (which
/// leaves other points no room), halfway from that end to the middle. Without one the middle.
inline double chosen_curvature(const CurvatureRange& range, std::optional<double> wanted) {
  const double middle = middle_curvature(range);
  if (!wanted) return middle;
  constexpr double kBesideEnd = 0.01;  // of the way from an end to the middle
  for (const double end : {range.low, range.high}) {
    if (std::isinf(end) || (*wanted - end) / (middle - end) > kBesideEnd) continue;
    return 0.5 * (end + middle);
  }
  return *wanted;
}

}  // namespace obvid::region_detail
