// SPDX-License-Identifier: Apache-2.0
#include "process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <ctime>
#include <fstream>
#include <sstream>

namespace judge {
namespace {

constexpr rlim_t kMemory = 8ULL << 30U;  // bytes
constexpr double kClock = 100.0;         // clock time over processor time, on a busy machine

/// In a child that still has its parent's memory: calls of the system alone.
[[noreturn]] void become(char* const* words, const char* folder, double limit) {
  const rlimit memory{kMemory, kMemory};
  const auto seconds = static_cast<rlim_t>(std::ceil(limit));
  const rlimit time{seconds, seconds + 1};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CPU, &time);
  if (chdir(folder) != 0) _exit(126);
  const int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  const int in = open("/dev/null", O_RDONLY);
  dup2(in, 0);
  dup2(out, 1);
  dup2(err, 2);
  execv(words[0], words);
  _exit(127);
}

double now() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

std::string text_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Finished run_program(const std::vector<std::string>& words, const std::string& folder,
                     double limit) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t child =
      vfork();  // a copy of the tables of all that was judged takes longer than many runs
  if (child == 0) become(argv.data(), folder.c_str(), limit);
  Finished out;
  const double start = now();
  int status = 0;
  rusage used{};
  double pause = 5e-4;
  while (wait4(child, &status, WNOHANG, &used) == 0) {
    if (now() - start > kClock * limit) {
      out.out_of_time = true;
      kill(child, SIGKILL);
    }
    usleep(static_cast<useconds_t>(pause * 1e6));
    pause = std::min(pause * 1.2, 0.01);
  }
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  out.seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  if (WIFEXITED(status)) {
    out.code = WEXITSTATUS(status);
  } else {
    out.code = -1;
    out.signal = WTERMSIG(status);
    out.out_of_time =
        out.out_of_time || out.signal == SIGXCPU || (out.signal == SIGKILL && out.seconds >= limit);
  }
  out.out = text_of_file(folder + "/stdout");
  out.err = text_of_file(folder + "/stderr");
  return out;
}

}  // namespace judge
