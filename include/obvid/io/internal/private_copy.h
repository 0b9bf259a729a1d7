// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "obvid/core/result.h"

namespace obvid {

/// A text in a file that only this user can read, for programs that read files alone; file and
/// folder are gone with the object. Not copied, only moved.
class PrivateCopy {
 public:
  /// `name`: what the file is called in its folder; what stands before the last slash is left out.
  /// Error: E102.
  [[nodiscard]] static Result<PrivateCopy> of(std::string_view text, const std::string& name);

  PrivateCopy(PrivateCopy&& other) noexcept;
  PrivateCopy& operator=(PrivateCopy&&) = delete;
  PrivateCopy(const PrivateCopy&) = delete;
  PrivateCopy& operator=(const PrivateCopy&) = delete;
  ~PrivateCopy();

  [[nodiscard]] std::string path() const { return (folder_ / name_).string(); }

 private:
  PrivateCopy(std::filesystem::path folder, std::string name);

  std::filesystem::path folder_;
  std::string name_;
};

}  // namespace obvid
