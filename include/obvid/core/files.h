// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "obvid/core/result.h"

namespace obvid {

/// Larger inputs are refused, endless ones among them: what is made of a text takes some times its
/// size in memory.
inline constexpr std::size_t kMostInputBytes = std::size_t{1} << 30;

/// The whole content of a file, pipe or device, read once from its beginning; "-" is standard
/// input. Errors: E301 it cannot be read, or is a folder; E310 more than `most` bytes (`value`: the
/// limit).
[[nodiscard]] Result<std::string> read_file(const std::string& path,
                                            std::size_t most = kMostInputBytes);

/// Its first bytes, as many as there are, to tell its kind by. Nothing of what can be read only
/// once: pipes, devices, "-".
[[nodiscard]] std::string head_of_file(const std::string& path, std::size_t bytes);

/// Writes the whole file or leaves what was there untouched: written beside, brought down to the
/// disk, then renamed, and the folder brought down too; holds after a loss of power.
///
/// - A new file has the permissions of new files. A replaced one keeps owner, group, permissions
/// and
///   access list as far as the system lets the user set them; what cannot be kept gives less
///   access, never more, and until it is complete only the user can read it. Root gives a file of
///   somebody else's back to them.
/// - A link stays a link: the file it leads to is written, also when that is not there yet.
/// - Of a file with several names (hard links) only the name given leads to the new content; the
///   others keep the old one. Writing into the old file would not be whole or nothing.
/// - Devices and pipes are written to. "-" writes to standard output, and so does "-.svg", a name
///   whose ending says what is written (is_standard_output).
/// - A writer that is killed leaves a file `.obvid-*.tmp` in the folder, which the next one of the
///   same target removes. Several writers of one target at once do not mix: the last one wins.
///
/// Error: E102; where there is no room it says how many bytes are needed (`value`) and free.
[[nodiscard]] Result<void> write_file(const std::string& path, std::string_view text);

/// "-" or "-" with an ending. A file that is called so has a folder before its name: "./-.svg".
[[nodiscard]] bool is_standard_output(const std::string& path);

/// Whether two names mean the same file, by whatever spelling or links, existing or about to be
/// written. Devices and pipes are nobody's.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

/// Refuses outputs that would replace an input or each other. Error: E203, `where`: the output.
[[nodiscard]] Result<void> check_outputs(std::span<const std::string> outputs,
                                         std::span<const std::string> inputs);

}  // namespace obvid
