// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/format_into.h"

#include <fmt/format.h>

#include <iterator>

namespace obvid {

void vformat_into(std::string& out, fmt::string_view format, fmt::format_args args) {
  fmt::vformat_to(std::back_inserter(out), format, args);
}

}  // namespace obvid
