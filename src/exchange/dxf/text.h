// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace obvid::dxf {

/// A name of the file as a user reads it: valid UTF-8 (bytes that are not are taken as Latin-1),
/// \U+00E4 decoded, no control characters, and not longer than a line.
[[nodiscard]] std::string to_label(std::string_view name);

}  // namespace obvid::dxf
