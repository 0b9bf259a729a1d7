// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace obvid {

/// The name most like `typed`, or "" when none is near (more than a third of the letters differ).
[[nodiscard]] std::string nearest_name(std::string_view typed,
                                       const std::vector<std::string>& names);

}  // namespace obvid
