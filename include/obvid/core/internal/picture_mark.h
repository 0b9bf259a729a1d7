// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// Attribute of the root of SVG files that are drawn to look at, frames and legends and all, and of
/// the value that tells readers of drawings not to take their lines for curves.
inline constexpr const char* kPictureAttribute = "data-obvid";
inline constexpr const char* kPictureValue = "picture";

}  // namespace obvid
