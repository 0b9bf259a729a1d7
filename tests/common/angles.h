// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace obvid {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kRightAngle = 0.5 * std::numbers::pi;

}  // namespace obvid
