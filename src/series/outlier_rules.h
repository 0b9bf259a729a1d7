// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace obvid {

// When a point is an outlier: docs/methods/series.md.
inline constexpr std::size_t kLeastCompared = 20;
/// Of the deviations that no point of a normal series exceeds.
inline constexpr double kClearly = 2.0;
/// Of what is left out, what may be left beside it: at a corner it is a third.
inline constexpr double kRest = 0.25;
/// The same where cubics over a chord miss the curve and those along the way are looked at instead:
/// a sparse nose is followed less well.
inline constexpr double kRestAroundNose = 0.125;
/// Cosine of the most that a curve turns over a gap, once on each side.
inline constexpr double kStraight = 0.7071067811865476;
/// Points on each side whose residuals tell how well cubics follow the curve there.
inline constexpr std::size_t kAround = 20;
inline constexpr std::size_t kMostInARow = 3;
inline constexpr double kMostOfAll = 0.1;

}  // namespace obvid
