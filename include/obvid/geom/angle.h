// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace obvid {

inline constexpr double kFullTurn = 2.0 * std::numbers::pi;   ///< rad
inline constexpr double kOneDegree = std::numbers::pi / 180;  ///< rad

}  // namespace obvid
