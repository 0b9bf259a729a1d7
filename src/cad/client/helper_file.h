// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "obvid/core/internal/part_program.h"
#include "obvid/core/result.h"

namespace obvid::cad {

inline constexpr const char* kHelperFile = "obvid-cad";

/// The helper with the mark of a build.
[[nodiscard]] PartProgram helper_with(std::string_view mark);

/// Folders in which the helper may lie, in the order they are looked at: the one that the user
/// names, and those of all parts; `own` is `own_file()`.
[[nodiscard]] std::vector<std::filesystem::path> helper_folders(const std::filesystem::path& own);

/// The helper of this build; where there is none yet and the launcher offers to build it, after
/// that. Error: E310.
[[nodiscard]] Result<std::filesystem::path> helper_file();

}  // namespace obvid::cad
