// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "obvid/core/result.h"

namespace obvid {

/// E202: "there is no such file of a comparison", "possible are .svg (picture), ...".
[[nodiscard]] inline ErrorBuilder no_such_file(const std::string& of, const std::string& possible) {
  return error(ErrorCode::kUnknownFormat, "there is no such file of " + of)
      .hint("possible are " + possible);
}

}  // namespace obvid
