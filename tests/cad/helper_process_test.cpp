// SPDX-License-Identifier: Apache-2.0
// The process of the helper, with small scripts in its place.
#include "helper_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "test_folder.h"

namespace obvid::cad {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class HelperProcess : public TestFolder {
 protected:
  void TearDown() override {
    errno = 0;
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
    EXPECT_EQ(errno, ECHILD);
    TestFolder::TearDown();
  }
};

TEST_F(HelperProcess, TheAnswerIsWhatItSendsUpToItsEnd) {
  const Answer answer = ask_helper(script("echo -n hello >&3"), "", {});
  EXPECT_EQ(answer.end, Answer::End::kAnswered);
  EXPECT_EQ(answer.bytes, "hello");
}

TEST_F(HelperProcess, MuchGoesBothWaysAtOnce) {
  std::string request(10'000'000, '\0');
  for (std::size_t i = 0; i < request.size(); ++i) request[i] = static_cast<char>(i * i / 7);
  const std::string all = std::to_string(request.size() + 8);
  const Answer answer = ask_helper(script("exec head -c " + all + " <&3 >&3"), request, {});
  ASSERT_EQ(answer.bytes.size(), request.size() + 8);
  EXPECT_TRUE(answer.bytes.substr(8) == request);
}

TEST_F(HelperProcess, OneThatEndsWithoutListeningIsNoSignalForUs) {
  ::signal(SIGPIPE, SIG_DFL);
  const Answer answer = ask_helper(script("exit 1"), std::string(1'000'000, 'x'), {});
  EXPECT_EQ(answer.end, Answer::End::kAnswered);
  EXPECT_TRUE(answer.bytes.empty());
}

TEST_F(HelperProcess, OneThatIsNotThereSaysWhy) {
  const Answer answer = ask_helper((folder_ / "none").string(), "", {});
  EXPECT_EQ(answer.end, Answer::End::kNotStarted);
  EXPECT_EQ(answer.reason, ENOENT);
}

TEST_F(HelperProcess, CancellingEndsItAtOnce) {
  const auto start = Clock::now();
  CadRun run;
  run.cancelled = [&] { return seconds_since(start) > 0.2; };
  const Answer answer = ask_helper(script("exec sleep 100"), "", run);
  EXPECT_EQ(answer.end, Answer::End::kCancelled);
  EXPECT_LT(seconds_since(start), 20.0);  // the machine may be busy
}

TEST_F(HelperProcess, TheClockEndsIt) {
  const auto start = Clock::now();
  CadRun run;
  run.seconds = 0.2;
  const Answer answer = ask_helper(script("exec sleep 100"), "", run);
  EXPECT_EQ(answer.end, Answer::End::kTooLong);
  EXPECT_LT(seconds_since(start), 20.0);
}

TEST_F(HelperProcess, TheEndOfProcessorTimeIsTold) {
  const Answer answer = ask_helper(script("kill -XCPU $$"), "", {});
  EXPECT_EQ(answer.end, Answer::End::kTooMuchWork);
}

TEST_F(HelperProcess, AHostThatTakesNoNoticeOfItsChildrenGetsItsAnswer) {
  const auto before = ::signal(SIGCHLD, SIG_IGN);
  const Answer answer = ask_helper(script("echo -n hello >&3"), "", {});
  ::signal(SIGCHLD, before);
  EXPECT_EQ(answer.bytes, "hello");
}

TEST_F(HelperProcess, NoDescriptorAndNoVariableOfTheHostReachesIt) {
  const int ours = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC, as hosts do
  ASSERT_GE(::dup2(ours, 77), 0);
  ::setenv("CSF_STEPDefaults", "/tmp", 1);
  ::setenv("LD_OBVID_TEST", "kept", 1);
  const Answer answer =
      ask_helper(script("ls /proc/$$/fd >&3; tr '\\0' ' ' </proc/$$/environ >&3"), "", {});
  ::close(77);
  ::close(ours);
  ::unsetenv("CSF_STEPDefaults");
  ::unsetenv("LD_OBVID_TEST");
  EXPECT_EQ(answer.bytes.find("77"), std::string::npos) << answer.bytes;
  EXPECT_EQ(answer.bytes.find("CSF_"), std::string::npos) << answer.bytes;
  EXPECT_NE(answer.bytes.find("LD_OBVID_TEST=kept"), std::string::npos) << answer.bytes;
}

TEST_F(HelperProcess, ManyAtOnceDoNotGetEachOthersAnswers) {
  const std::string echo = script("exec head -c 12 <&3 >&3");
  std::vector<std::string> answers(16);
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < answers.size(); ++k) {
    threads.emplace_back(
        [&, k] { answers[k] = ask_helper(echo, std::to_string(1000 + k), {}).bytes.substr(8); });
  }
  for (std::thread& one : threads) one.join();
  for (std::size_t k = 0; k < answers.size(); ++k) EXPECT_EQ(answers[k], std::to_string(1000 + k));
}

}  // namespace
}  // namespace obvid::cad
