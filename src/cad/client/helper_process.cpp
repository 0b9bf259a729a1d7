// SPDX-License-Identifier: Apache-2.0
#include "helper_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

extern char** environ;  // NOLINT: POSIX declares it nowhere

namespace obvid::cad {
namespace {

using Clock = std::chrono::steady_clock;

/// Between two questions whether the work is still wanted.
constexpr std::chrono::milliseconds kPatience(50);

/// Closed at the end of its life.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  void take(int number) {
    close();
    number_ = number;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// What the new process starts with: our input (a file may be called /dev/stdin), no output,
/// because the kernel talks to the terminal, the socket, and no other descriptor or signal of ours.
class Start {
 public:
  explicit Start(int socket) {
    ::posix_spawn_file_actions_init(&actions_);
    // first, in case that the socket has a number below
    ::posix_spawn_file_actions_adddup2(&actions_, socket, kHelperSocket);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, kHelperSocket + 1);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    sigset_t none, usual;
    ::sigemptyset(&none);
    ::sigemptyset(&usual);
    for (const int signal : {SIGSEGV, SIGFPE, SIGABRT, SIGBUS, SIGILL, SIGPIPE, SIGXCPU, SIGCHLD}) {
      ::sigaddset(&usual, signal);
    }
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &usual);
  }
  Start(const Start&) = delete;
  Start& operator=(const Start&) = delete;
  ~Start() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  /// 0, or why it did not start.
  int run(const std::string& program, pid_t& process) {
    std::string name = program;
    std::array<char*, 2> arguments = {name.data(), nullptr};
    std::vector<char*> kept;
    for (char** one = environ; one != nullptr && *one != nullptr; ++one) {
      if (std::strncmp(*one, "LD_", 3) == 0) kept.push_back(*one);
    }
    kept.push_back(nullptr);
    return ::posix_spawn(&process, program.c_str(), &actions_, &attributes_, arguments.data(),
                         kept.data());
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// A helper at work; killed when it is given up.
class Helper {
 public:
  Helper() = default;
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;
  ~Helper() {
    if (process_ > 0) {
      ::kill(process_, SIGKILL);
      (void)ended();
    }
  }

  int start(const std::string& program) {
    std::array<int, 2> pair{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return errno;
    socket_.take(pair[0]);
    const Descriptor theirs(pair[1]);
    pid_t process = -1;
    const int reason = Start(theirs.number()).run(program, process);
    if (reason == 0) process_ = process;
    return reason;
  }

  [[nodiscard]] int socket() const { return socket_.number(); }

  /// Waits for its end, which is near; the signal that ended it or 0. A host that waits for all
  /// children may have got the answer before us.
  int ended() {
    const pid_t process = std::exchange(process_, -1);
    int status = 0;
    while (::waitpid(process, &status, 0) < 0) {
      if (errno != EINTR) return 0;
    }
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

 private:
  pid_t process_ = -1;
  Descriptor socket_;
};

/// Both directions at once: neither side waits for the other to read.
class Talk {
 public:
  Talk(int socket, std::string_view request) : socket_(socket), request_(request) {
    const std::uint64_t size = request.size();
    std::memcpy(head_.data(), &size, sizeof size);
    left_ = {head_.data(), head_.size()};
  }

  /// Waits a little and moves what can be moved; false at the end of the answer.
  bool go_on(int milliseconds, std::string& answer) {
    pollfd one{socket_, static_cast<short>(POLLIN | (left_.empty() ? 0 : POLLOUT)), 0};
    if (::poll(&one, 1, milliseconds) <= 0) return true;
    if ((one.revents & POLLOUT) != 0) send();
    if ((one.revents & (POLLIN | POLLHUP | POLLERR)) != 0) return receive(answer);
    return true;
  }

 private:
  void send() {
    const ssize_t n = ::send(socket_, left_.data(), left_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n > 0) left_.remove_prefix(static_cast<std::size_t>(n));
    if (n < 0 && errno != EINTR && errno != EAGAIN) request_ = left_ = {};  // it has gone
    if (left_.empty()) left_ = std::exchange(request_, {});
  }
  bool receive(std::string& answer) {
    const ssize_t n = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (n > 0) answer.append(buffer_.data(), static_cast<std::size_t>(n));
    return n > 0 || (n < 0 && (errno == EINTR || errno == EAGAIN));
  }

  int socket_;
  std::string_view request_;
  std::string_view left_;
  std::array<char, sizeof(std::uint64_t)> head_{};
  std::array<char, 1 << 16> buffer_{};
};

}  // namespace

Answer ask_helper(const std::string& program, std::string_view request, const CadRun& run) {
  Answer answer;
  Helper helper;
  answer.reason = helper.start(program);
  if (answer.reason != 0) {
    answer.end = Answer::End::kNotStarted;
    return answer;
  }
  const auto start = Clock::now();
  const std::chrono::duration<double> most(run.seconds.value_or(0.0));
  auto asked = start;
  Talk talk(helper.socket(), request);
  while (talk.go_on(static_cast<int>(kPatience.count()), answer.bytes)) {
    const auto now = Clock::now();
    if (most.count() > 0.0 && now - start > most) answer.end = Answer::End::kTooLong;
    if (answer.bytes.size() > kMostBytes) answer.end = Answer::End::kTooLarge;
    if (run.cancelled && now - asked >= kPatience) {
      asked = now;
      if (run.cancelled()) answer.end = Answer::End::kCancelled;
    }
    if (answer.end != Answer::End::kAnswered) return answer;
  }
  if (helper.ended() == SIGXCPU) answer.end = Answer::End::kTooMuchWork;
  return answer;
}

}  // namespace obvid::cad
