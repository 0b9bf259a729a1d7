// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid::exchange {

// What controllers take for an arc.
inline constexpr int kLeastCentreDecimals = 5;
inline constexpr double kLowestArc = 0.5;  ///< last digits: height of arcs that are told as such
inline constexpr double kShortestChord = 20.0;  ///< last digits: below, rounding turns an arc too
                                                ///< much
/// A radius that LinuxCNC takes for none (0.00127 mm), and some.
inline constexpr double kSmallestRadius = 0.002;

}  // namespace obvid::exchange
