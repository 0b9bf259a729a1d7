// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace obvid {

/// The name most like `typed`, or "" when none is near (more than a third of the letters differ).
[[nodiscard]] std::string nearest_name(std::string_view typed,
                                       const std::vector<std::string>& names);

/// "did you mean NAME?", or `otherwise` when no name is near.
[[nodiscard]] std::string did_you_mean(const std::string& typed,
                                       const std::vector<std::string>& names,
                                       const std::string& otherwise);

}  // namespace obvid
