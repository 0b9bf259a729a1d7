// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/geom/element.h"

namespace obvid::conics {

/// What the region cuts out of the median, as parts of the way from the chord to the apex.
struct MedianCut {
  double low = 0.0;
  double high = 0.0;
};

[[nodiscard]] std::optional<MedianCut> median_cut(const Element& start, const Element& end);

}  // namespace obvid::conics
