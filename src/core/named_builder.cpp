// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/named_builder.h"

#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string>

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace obvid {

bool run_named_builder(const char* variable) {
  const char* named = ::secure_getenv(variable);
  if (named == nullptr || *named == '\0') return false;
  std::string builder = named;
  char* const arguments[] = {builder.data(), nullptr};
  posix_spawn_file_actions_t actions;
  if (::posix_spawn_file_actions_init(&actions) != 0) return false;
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  pid_t process = 0;
  const int failed = ::posix_spawn(&process, named, &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return false;
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace obvid
