// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/core/result.h"

namespace obvid::pipeline_detail {

/// E202: "there is no such file of a comparison", "possible are .svg (picture), ...".
[[nodiscard]] inline ErrorBuilder no_such_file(const char* of, const char* possible) {
  return error(ErrorCode::kUnknownFormat, std::string("there is no such file of ") + of)
      .hint(std::string("possible are ") + possible);
}

}  // namespace obvid::pipeline_detail
