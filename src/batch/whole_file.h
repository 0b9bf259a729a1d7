// SPDX-License-Identifier: Apache-2.0
// Files that libraries write themselves, whole or not at all.
#pragma once

#include <string>

namespace obvid::batch {

/// A name beside the file that no other process uses.
[[nodiscard]] std::string temporary_name(const std::string& path);

/// Brings the file down to the disk, gives it its name, and brings the folder down; false when that
/// fails, and `errno` says why.
[[nodiscard]] bool put_in_place(const std::string& temporary, const std::string& path);

}  // namespace obvid::batch
