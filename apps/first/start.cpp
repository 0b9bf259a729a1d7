// SPDX-License-Identifier: Apache-2.0
#include "start.h"

#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "commands.h"
#include "obvid/core/files.h"
#include "terminal.h"

namespace obvid {
namespace {

char** started_with = nullptr;
off_t began_at = -1;  // of standard input; -1: nothing is to be read again

constexpr std::size_t kKeptBlock = std::size_t{1} << 16U;

bool write_all(int file, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t done = ::write(file, bytes, count);
    if (done < 0) return false;
    bytes += done;
    count -= static_cast<std::size_t>(done);
  }
  return true;
}

/// What comes through a pipe, in memory. More than the program accepts is not kept: it is refused.
void keep_pipe() {
  const int kept = ::memfd_create("standard input", 0);
  if (kept < 0) return;
  std::vector<char> block(kKeptBlock);
  std::size_t total = 0;
  for (ssize_t got = 1; got > 0 && total <= kMostInputBytes;
       total += static_cast<std::size_t>(got)) {
    got = ::read(STDIN_FILENO, block.data(), block.size());
    if (got < 0 || !write_all(kept, block.data(), static_cast<std::size_t>(got))) break;
  }
  ::lseek(kept, 0, SEEK_SET);
  ::dup2(kept, STDIN_FILENO);
  ::close(kept);
  began_at = 0;
}

}  // namespace

void keep_start(char** argv) {
  started_with = argv;
  std::string_view before;
  for (char** argument = argv; *argument != nullptr; before = *argument++) {
    const bool output = before == "-o" || before == "--output";
    if (std::string_view(*argument) == "-" && !output) return keep_standard_input();
  }
}

void keep_standard_input() {
  if (began_at >= 0) return;
  began_at = ::lseek(STDIN_FILENO, 0, SEEK_CUR);
  if (began_at < 0) keep_pipe();
}

void go_on_in_the_whole_program() {
  if (const char* launcher = ::secure_getenv("OBVID_LAUNCHER")) {
    if (began_at >= 0) ::lseek(STDIN_FILENO, began_at, SEEK_SET);
    ::setenv("OBVID_WHOLE", "1", 1);
    ::execv(launcher, started_with);
  }
  std::exit(report({ErrorCode::kUnsupported, "this program holds `fit` and `analyse` alone", "",
                    "start it through the launcher `obvid`, which builds the whole one"}));
}

}  // namespace obvid
