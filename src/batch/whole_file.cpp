// SPDX-License-Identifier: Apache-2.0
#include "whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>

namespace obvid::batch {
namespace {

bool brought_down(const std::string& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::fsync(file) == 0;
  return ::close(file) == 0 && done;
}

}  // namespace

std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> number{0};
  char host[64] = "";  // batches of several machines may share a folder
  ::gethostname(host, sizeof host - 1);
  return path + "." + host + "-" + std::to_string(::getpid()) + "-" + std::to_string(++number) +
         ".tmp";
}

bool put_in_place(const std::string& temporary, const std::string& path) {
  if (!brought_down(temporary, O_RDWR)) return false;
  if (std::rename(temporary.c_str(), path.c_str()) != 0) return false;
  const std::size_t slash = path.find_last_of('/');
  (void)brought_down(slash == std::string::npos ? "." : path.substr(0, slash + 1),
                     O_RDONLY | O_DIRECTORY);  // some file systems cannot
  return true;
}

}  // namespace obvid::batch
