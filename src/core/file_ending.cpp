// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/file_ending.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace obvid {
namespace {

char small_letter(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

}  // namespace

std::string ending_of(const std::string& path) {
  std::string out = std::filesystem::path(path).extension().string();
  std::transform(out.begin(), out.end(), out.begin(), small_letter);
  return out;
}

bool has_ending(std::string_view path, std::string_view endings) {
  while (!endings.empty()) {
    const std::string_view one = endings.substr(0, endings.find(' '));
    if (path.size() >= one.size() &&
        std::equal(one.begin(), one.end(), path.end() - static_cast<std::ptrdiff_t>(one.size()),
                   [](char a, char b) { return a == small_letter(b); })) {
      return true;
    }
    endings.remove_prefix(std::min(endings.size(), one.size() + 1));
  }
  return false;
}

}  // namespace obvid
