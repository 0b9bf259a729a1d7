// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace obvid::dxf {

/// A name of the file as a user reads it: valid UTF-8 (bytes that are not are taken as Latin-1),
/// \U+00E4 decoded, no control characters, and not longer than a line, or than `longest`
/// characters.
[[nodiscard]] std::string to_label(std::string_view name, std::size_t longest = 60);

/// The longest name that DXF has, characters.
inline constexpr std::size_t kLongestName = 255;

/// A name of a layer in an R2000 file: letters of Latin-1 as bytes of
/// its code page, others as \U+0416, what may not stand in such
/// names as _ . "0" for nothing.
[[nodiscard]] std::string layer_name(std::string_view label);

}  // namespace obvid::dxf
