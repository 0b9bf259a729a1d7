// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace obvid {

/// The ending of a file's name with its dot, in lower case: ".csv". Empty where there is none.
[[nodiscard]] std::string ending_of(const std::string& path);

/// Whether a name ends with one of these, ".step .stp", in letters of any case.
[[nodiscard]] bool has_ending(std::string_view path, std::string_view endings);

}  // namespace obvid
