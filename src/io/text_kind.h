// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "obvid/core/result.h"

namespace obvid::text {

/// Refuses what is no text with points, by its content: E306 for binary data, E310 for formats
/// that are known but not read (DXF, STEP, IGES, JSON, XML and its children).
[[nodiscard]] Result<void> check_text_kind(std::string_view text, std::string_view name);

}  // namespace obvid::text
