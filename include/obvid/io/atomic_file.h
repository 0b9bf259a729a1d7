// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "obvid/core/result.h"

namespace obvid {

/// Writes the whole file or leaves what was there untouched: written beside, then renamed.
/// "-" writes to standard output. Error: E102.
[[nodiscard]] Result<void> write_file(const std::string& path, std::string_view text);

}  // namespace obvid
