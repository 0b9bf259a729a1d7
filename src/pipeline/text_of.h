// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"

namespace obvid::pipeline_detail {

/// Whole text of a file. Error: E301.
[[nodiscard]] Result<std::string> text_of(const std::string& path);

}  // namespace obvid::pipeline_detail
