// SPDX-License-Identifier: Apache-2.0
#include "text_of.h"

#include <fstream>
#include <sstream>

namespace obvid::pipeline_detail {

Result<std::string> text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) {
    return fail({ErrorCode::kCannotOpen, "cannot read the file", path,
                 "check the path and the permissions", -1, 0.0});
  }
  return text.str();
}

}  // namespace obvid::pipeline_detail
