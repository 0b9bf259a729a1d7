// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "temporary_file.h"

namespace obvid {
namespace {

/// Bytes that are free in the folder of a file.
std::optional<unsigned long long> room_beside(const std::string& file) {
  const std::string folder = folder_of(file);
  struct statvfs disk {};
  if (::statvfs(folder.empty() ? "." : folder.c_str(), &disk) != 0) return std::nullopt;
  return static_cast<unsigned long long>(disk.f_bavail) * disk.f_frsize;
}

Error no_room(const std::string& path, std::size_t needed, std::optional<unsigned long long> free) {
  Error error;
  error.code = ErrorCode::kWriteFailed;
  error.what = fmt::format("there is no room for the file: it needs {} bytes", needed);
  if (free) error.what += fmt::format(", {} are free", *free);
  error.where = path;
  error.hint = "make room or choose a folder on another disk";
  error.value = static_cast<double>(needed);
  return error;
}

Error write_failed(const std::string& path, int reason) {
  Error error;
  error.code = ErrorCode::kWriteFailed;
  error.what = std::string("cannot write the file: ") + std::strerror(reason);
  error.where = path;
  error.hint = "check that the folder exists and may be written to";
  return error;
}

/// `beside`: a file whose disk is meant, where it is one.
Result<void> outcome(const std::string& path, int reason, std::size_t size,
                     const std::string& beside = {}) {
  if (reason == 0) return {};
  const bool full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  if (!full) return fail(write_failed(path, reason));
  const bool disk = reason == ENOSPC && !beside.empty();
  return fail(no_room(path, size, disk ? room_beside(beside) : std::nullopt));
}

/// 0 or errno. What was begun is gone when it returns.
int replaced(const std::string& target, std::string_view text, const struct stat* old) {
  TemporaryFile beside(target, old);
  if (beside.reason() != 0) return beside.reason();
  if (const int reason = beside.write(text); reason != 0) return reason;
  return beside.take_place();
}

Result<void> replace(const std::string& path, std::string_view text, const struct stat* old) {
  const std::string target = behind_links(path);
  if (target.empty()) return outcome(path, errno, text.size());
  return outcome(path, replaced(target, text, old), text.size(), target);
}

/// Folder and name that a path leads to, behind all links.
struct OutputPlace {
  struct stat folder {};
  std::string name;
};

std::optional<OutputPlace> output_place(const std::string& path) {
  const std::string target = behind_links(path), folder = folder_of(target);
  OutputPlace place;
  place.name = target.substr(folder.size());
  const bool there = ::stat(folder.empty() ? "." : folder.c_str(), &place.folder) == 0;
  return there && !place.name.empty() ? std::optional(place) : std::nullopt;
}

bool is_one(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

Result<void> write_in_place(const std::string& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return outcome(path, errno, text.size());
  const int reason = write_all(file, text);
  const int closed = ::close(file) == 0 ? 0 : errno;
  return outcome(path, reason != 0 ? reason : closed, text.size());
}

}  // namespace

bool is_standard_output(const std::string& path) {
  return path == "-" || (path.starts_with("-.") && path.find('/') == std::string::npos);
}

Result<void> write_file(const std::string& path, std::string_view text) {
  if (is_standard_output(path)) {
    // What others printed through stdio comes first.
    const int reason = std::fflush(stdout) != 0 ? errno : write_all(STDOUT_FILENO, text);
    return outcome("standard output", reason, text.size());
  }
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0) {
    if (errno != ENOENT) return outcome(path, errno, text.size());
    return replace(path, text, nullptr);
  }
  if (S_ISDIR(old.st_mode)) return outcome(path, EISDIR, text.size());
  // Devices and pipes cannot be replaced, only written to.
  if (!S_ISREG(old.st_mode)) return write_in_place(path, text);
  if (::access(path.c_str(), W_OK) != 0) return outcome(path, errno, text.size());
  return replace(path, text, &old);
}

bool same_file(const std::string& a, const std::string& b) {
  struct stat at_a {
  }, at_b{};
  const bool a_is = ::stat(a.c_str(), &at_a) == 0, b_is = ::stat(b.c_str(), &at_b) == 0;
  if (a_is && b_is) return S_ISREG(at_a.st_mode) && is_one(at_a, at_b);
  if (a_is != b_is) return false;
  const auto place_a = output_place(a), place_b = output_place(b);
  if (!place_a || !place_b) return a == b;
  return place_a->name == place_b->name && is_one(place_a->folder, place_b->folder);
}

Result<void> check_outputs(std::span<const std::string> outputs,
                           std::span<const std::string> inputs) {
  const auto refused = [](const std::string& path, const char* why) {
    return error(ErrorCode::kBadOption, why).where(path).hint("choose another name");
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (is_standard_output(outputs[i])) {
      const auto others = outputs.subspan(0, i);
      if (std::any_of(others.begin(), others.end(), is_standard_output)) {
        return refused("-", "two outputs would go to standard output");
      }
      continue;
    }
    for (const std::string& input : inputs) {
      // what is redirected to standard input is a file with a name, too
      if (same_file(outputs[i], input == "-" ? "/dev/stdin" : input)) {
        return refused(outputs[i], "the output would replace the input");
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (same_file(outputs[i], outputs[k])) {
        return refused(outputs[i], "two outputs would be the same file");
      }
    }
  }
  return {};
}

}  // namespace obvid
