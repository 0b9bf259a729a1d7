// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/internal/private_copy.h"

#include <stdlib.h>  // mkdtemp

#include <fstream>
#include <system_error>
#include <utility>

namespace obvid {

Result<PrivateCopy> PrivateCopy::of(std::string_view text, const std::string& name) {
  std::error_code trouble;
  const auto place = std::filesystem::temp_directory_path(trouble);
  std::string folder = (place / "obvid-XXXXXX").string();
  if (trouble || ::mkdtemp(folder.data()) == nullptr) {
    return error(ErrorCode::kWriteFailed, "no folder could be made for a file in between")
        .where(place.string())
        .hint("set TMPDIR to a folder that may be written");
  }
  std::string called = std::filesystem::path(name).filename().string();
  if (called.empty() || called == "." || called == "..") called = "text";
  PrivateCopy out(folder, std::move(called));
  std::ofstream file(out.path(), std::ios::binary);
  if (!file.write(text.data(), static_cast<std::streamsize>(text.size())).flush()) {
    return error(ErrorCode::kWriteFailed, "a file in between could not be written")
        .where(folder)
        .hint("set TMPDIR to a folder with more room");
  }
  return out;
}

PrivateCopy::PrivateCopy(std::filesystem::path folder, std::string name)
    : folder_(std::move(folder)), name_(std::move(name)) {}

PrivateCopy::PrivateCopy(PrivateCopy&& other) noexcept
    : folder_(std::exchange(other.folder_, {})), name_(std::move(other.name_)) {}

PrivateCopy::~PrivateCopy() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

}  // namespace obvid
