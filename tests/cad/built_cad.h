// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/cad/internal/cad.h"

namespace obvid {

/// Whether the helper was left out of this build, as its maker says. Where it was built, a helper
/// that is not found or not accepted is a fault, no reason to skip.
#ifdef OBVID_CAD_BUILT
inline constexpr bool kCadIsMissing = false;
#else
inline constexpr bool kCadIsMissing = true;
#endif
inline constexpr const char* kCadMissing = "the helper for CAD files is not built";

}  // namespace obvid
