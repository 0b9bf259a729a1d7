// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// A point that lies off the curve of its neighbours.
struct Outlier {
  std::size_t index = 0;
  double off = 0.0;  ///< distance from the cubic through two neighbours on each side, units
};

struct Outliers {
  std::vector<Outlier> points;     ///< in order
  double deviation = 0.0;          ///< of all points, those that go too, from the cubics of their
                                   ///< neighbours, units, for the error of one point
  double limit = 0.0;              ///< deviations beyond which a point is one
  std::vector<Outlier> staying{};  ///< of those that are left, farther off than the limit all
                                   ///< the same: beside corners and sharp bends, and with data
  std::vector<std::size_t> untold{};  ///< of those that are left, that have no such cubic
};

/// Points of measured series that are farther from the cubic through two neighbours on each side
/// than twice what none of the points would be, 95 times of 100, were all errors normal, and
/// without which, up to three in a row and each of them off, their neighbours follow one another.
/// Deviations are medians (Hampel 1974), of the whole series or of the points around, whichever is
/// larger: where a curve bends sharply the cubics miss it. There neighbours may follow cubics over
/// the lengths of their chords instead, which go around a nose. A corner is no outlier: what is
/// beside it stays off without it.
///
/// The two points at each end have no such cubic: up to three there are outliers where
/// `without_end_strays` says so of what is left. Not looked at are points whose neighbours do not
/// advance along their chord, and those with `kept`. A point that is not between its neighbours
/// along their chord is as far off as from the line between them. Cost O(n log n) for few outliers.
/// Errors: E304 fewer than 20 points can be compared; E311 more than a tenth of the points would be
/// outliers.
[[nodiscard]] Result<Outliers> outliers_of(const std::vector<Vec2>& points,
                                           const std::vector<bool>& kept = {});

}  // namespace obvid
