// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace obvid::contour_json {

inline constexpr std::string_view kFormat = "obvid-contour";
inline constexpr int kVersion = 1;

}  // namespace obvid::contour_json
