// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <span>
#include <string>
#include <string_view>

#include "obvid/core/result.h"

namespace obvid {

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
/// - Devices and pipes are written to. "-" writes to standard output.
/// - A writer that is killed leaves a file `.obvid-*.tmp` in the folder, which the next one of the
///   same target removes. Several writers of one target at once do not mix: the last one wins.
///
/// Error: E102; where there is no room it says how many bytes are needed (`value`) and free.
[[nodiscard]] Result<void> write_file(const std::string& path, std::string_view text);

/// Whether two names mean the same file, by whatever spelling or links, existing or about to be
/// written. Devices and pipes are nobody's.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

/// Refuses outputs that would replace an input or each other. Error: E203, `where`: the output.
[[nodiscard]] Result<void> check_outputs(std::span<const std::string> outputs,
                                         std::span<const std::string> inputs);

}  // namespace obvid
