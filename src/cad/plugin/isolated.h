// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace obvid::cad {

/// Runs `work` in a process of its own and returns the bytes that it gave; what it gave so far, or
/// nothing, when it crashed or took more than 20 seconds of processor time. The kernel's readers do
/// both on damaged files.
[[nodiscard]] std::string isolated(const std::function<std::string()>& work);

}  // namespace obvid::cad
