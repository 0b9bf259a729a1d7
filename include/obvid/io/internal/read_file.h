// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

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

}  // namespace obvid
