// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace obvid {
namespace {

// Names tried for the file beside; each taken one belongs to another writer at work.
constexpr int kMaxNames = 100;

// Permissions of a new file before the user's mask.
constexpr mode_t kNewFileMode = 0666;
constexpr mode_t kPermissionBits = 07777;

Error write_failed(const std::string& path, int reason) {
  Error error;
  error.code = ErrorCode::kWriteFailed;
  error.what = std::string("cannot write the file: ") + std::strerror(reason);
  error.where = path;
  error.hint = "check that the folder exists, may be written to and has room";
  return error;
}

// 0, or the reason why not all was written.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

int write_and_close(int file, std::string_view text) {
  const int reason = write_all(file, text);
  const int closed = ::close(file) == 0 ? 0 : errno;
  return reason != 0 ? reason : closed;
}

Result<void> outcome(const std::string& path, int reason) {
  if (reason != 0) return fail(write_failed(path, reason));
  return {};
}

// A link stays a link: what it points to is replaced.
std::string behind_links(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), &std::free);
  return real ? std::string(real.get()) : path;
}

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

// Creates a file of its own beside `target`; -1 with errno when that fails.
int create_beside(const std::string& target, std::string& name) {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < kMaxNames; ++attempt) {
    name = folder_of(target) + ".obvid-" + std::to_string(::getpid()) + "-" +
           std::to_string(counter++) + ".tmp";
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
    if (file >= 0 || errno != EEXIST) return file;
  }
  return -1;
}

Result<void> replace(const std::string& path, std::string_view text, const struct stat* old) {
  const std::string target = behind_links(path);
  std::string beside;
  const int file = create_beside(target, beside);
  if (file < 0) return outcome(path, errno);
  int reason = 0;
  if (old != nullptr && ::fchmod(file, old->st_mode & kPermissionBits) != 0) reason = errno;
  const int written = write_and_close(file, reason == 0 ? text : std::string_view());
  if (reason == 0) reason = written;
  if (reason == 0 && ::rename(beside.c_str(), target.c_str()) != 0) reason = errno;
  if (reason != 0) ::unlink(beside.c_str());
  return outcome(path, reason);
}

Result<void> write_in_place(const std::string& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return outcome(path, errno);
  return outcome(path, write_and_close(file, text));
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view text) {
  if (path == "-") {
    // What others printed through stdio comes first.
    if (std::fflush(stdout) != 0) return outcome("standard output", errno);
    return outcome("standard output", write_all(STDOUT_FILENO, text));
  }
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0) {
    if (errno != ENOENT) return outcome(path, errno);
    return replace(path, text, nullptr);
  }
  if (S_ISDIR(old.st_mode)) return outcome(path, EISDIR);
  // Devices and pipes cannot be replaced, only written to.
  if (!S_ISREG(old.st_mode)) return write_in_place(path, text);
  if (::access(path.c_str(), W_OK) != 0) return outcome(path, errno);
  return replace(path, text, &old);
}

}  // namespace obvid
