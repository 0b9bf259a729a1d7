// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// By definition, of 1959.
inline constexpr double kMmPerInch = 25.4;

}  // namespace obvid
