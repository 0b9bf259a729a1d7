// SPDX-License-Identifier: Apache-2.0
#include "isolated.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

namespace obvid::cad {
namespace {

constexpr rlim_t kMostSeconds = 20;
constexpr rlim_t kMostBytes = rlim_t{4} << 30;  // damaged counts ask for any amount of memory

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

[[noreturn]] void child(int pipe, const std::function<std::string()>& work) {
  limit(RLIMIT_CPU, kMostSeconds);
  limit(RLIMIT_AS, kMostBytes);
  limit(RLIMIT_CORE, 0);
  const int nowhere = ::open("/dev/null", O_WRONLY);  // the kernel talks to the terminal
  if (nowhere >= 0) {
    ::dup2(nowhere, STDOUT_FILENO);
    ::dup2(nowhere, STDERR_FILENO);
  }
  for (const int signal : {SIGSEGV, SIGFPE, SIGABRT, SIGBUS, SIGILL}) ::signal(signal, SIG_DFL);
  const std::string bytes = work();
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(pipe, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  ::_exit(0);  // nothing of the parent's is flushed twice
}

std::string read_all(int pipe) {
  std::string bytes;
  std::array<char, 1 << 16> buffer{};
  for (;;) {
    const ssize_t n = ::read(pipe, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

std::string isolated(const std::function<std::string()>& work) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) return {};
  const pid_t process = ::fork();
  if (process == 0) {
    ::close(pipe[0]);
    child(pipe[1], work);
  }
  ::close(pipe[1]);
  std::string bytes = process > 0 ? read_all(pipe[0]) : std::string{};
  ::close(pipe[0]);
  while (process > 0 && ::waitpid(process, nullptr, 0) < 0 && errno == EINTR) {
  }
  return bytes;
}

}  // namespace obvid::cad
