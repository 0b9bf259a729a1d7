// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "obvid/core/result.h"

namespace obvid {

/// A program that belongs to this one and is started when it is needed.
struct PartProgram {
  std::string_view what;  ///< "the helper for STEP, IGES and BREP": for errors
  std::string_view file;  ///< its name, without a folder
  std::string_view mark;  ///< bytes that its file holds when it is of this build
};

/// The file of the program or shared library that holds this code; empty where the system does not
/// tell.
[[nodiscard]] std::filesystem::path own_file();

/// Folders in which parts lie, in the order they are looked at: that of `own` (`own_file()`), and
/// where the installation puts them, `../libexec/obvid` from there.
[[nodiscard]] std::vector<std::filesystem::path> part_folders(const std::filesystem::path& own);

/// Whether a file may be started as that part: a plain file, not writable for everybody, of root's,
/// of the user's or of the owner of `own`, with the mark. Looked at from outside, nothing of it
/// runs. The mark tells a stale file, it is no signature. E310 says why not.
[[nodiscard]] Result<void> check_part(const std::filesystem::path& file,
                                      const std::filesystem::path& own, const PartProgram& part);

/// The first file of that name in the folders, when it may be started; nothing where there is none.
/// Errors: those of `check_part`.
[[nodiscard]] Result<std::optional<std::filesystem::path>> find_part(
    const std::vector<std::filesystem::path>& folders, const std::filesystem::path& own,
    const PartProgram& part);

}  // namespace obvid
