// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/format_into.h"

#include <fmt/format.h>

namespace obvid {

void vformat_into(std::string& out, fmt::string_view format, fmt::format_args args) {
  fmt::memory_buffer text;
  fmt::vformat_to(fmt::appender(text), format, args);
  out.append(text.data(), text.size());
}

}  // namespace obvid
