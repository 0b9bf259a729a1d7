// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"

namespace obvid::cad {

inline constexpr const char* kHelperFile = "obvid-cad";

/// The file of the program or shared library that holds this code; empty where the system does not
/// tell.
[[nodiscard]] std::filesystem::path own_file();

/// Folders in which the helper may lie, in the order they are looked at; `own` is `own_file()`.
[[nodiscard]] std::vector<std::filesystem::path> helper_folders(const std::filesystem::path& own);

/// Whether a file found there may be started: looked at from outside, nothing of it runs. E310 says
/// why not.
[[nodiscard]] Result<void> check_helper(const std::filesystem::path& file,
                                        const std::filesystem::path& own, std::string_view mark);

/// The helper of this build; where there is none yet and the launcher offers to build it, after
/// that. Error: E310.
[[nodiscard]] Result<std::filesystem::path> helper_file();

}  // namespace obvid::cad
