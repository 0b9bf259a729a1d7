// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

namespace obvid {
namespace {

/// Bytes asked for at a time; large enough that the number of calls does not count.
constexpr std::size_t kReadBlock = std::size_t{1} << 20U;

Error cannot_read(const std::string& path, const std::string& why) {
  return error(ErrorCode::kCannotOpen, "cannot read the file: " + why)
      .where(path)
      .hint("check the path and the permissions");
}

Error too_large(const std::string& path, std::size_t most) {
  return error(ErrorCode::kUnsupported, fmt::format("the input is larger than {} bytes", most))
      .where(path)
      .hint("give a part of it, or fewer digits and columns")
      .value(static_cast<double>(most));
}

Result<std::string> read_stream(std::FILE* stream, const std::string& path, std::size_t most) {
  std::string text;
  for (std::size_t got = kReadBlock; got == kReadBlock;) {
    const std::size_t used = text.size();
    text.resize(used + kReadBlock);
    got = std::fread(text.data() + used, 1, kReadBlock, stream);
    text.resize(used + got);
    if (text.size() > most) return fail(too_large(path, most));
  }
  if (std::ferror(stream) != 0) return fail(cannot_read(path, std::strerror(errno)));
  return text;
}

}  // namespace

Result<std::string> read_file(const std::string& path, std::size_t most) {
  if (path == "-") return read_stream(stdin, "standard input", most);
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    return fail(cannot_read(path, "it is a folder"));
  }
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) return fail(cannot_read(path, std::strerror(errno)));
  return read_stream(file.get(), path, most);
}

std::string head_of_file(const std::string& path, std::size_t bytes) {
  std::error_code ignored;
  if (path == "-" || !std::filesystem::is_regular_file(path, ignored)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string head(bytes, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

}  // namespace obvid
