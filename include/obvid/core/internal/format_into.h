// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/core.h>

#include <string>

namespace obvid {

/// Appends formatted text. fmt::format_to would compile the whole formatter once more in every file
/// that uses it; here it is compiled once.
void vformat_into(std::string& out, fmt::string_view format, fmt::format_args args);

template <class... Args>
void format_into(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  vformat_into(out, fmt::string_view(format), fmt::make_format_args(args...));
}

}  // namespace obvid
