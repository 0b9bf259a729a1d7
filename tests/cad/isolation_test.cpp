// SPDX-License-Identifier: Apache-2.0
// The kernel and the process that calls it keep out of each other's way.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "../common/text.h"
#include "built_cad.h"
#include "obvid/cad/internal/cad.h"
#include "test_folder.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;
using SteadyClock = std::chrono::steady_clock;

class CadIsolation : public TestFolder {
 protected:
  void SetUp() override {
    if (kCadIsMissing) GTEST_SKIP() << kCadMissing;
    TestFolder::SetUp();
  }
  void TearDown() override {
    if (!folder_.empty()) TestFolder::TearDown();
  }
  std::string file(const std::string& name, const std::string& text) {
    const fs::path path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
  }
  /// Nobody writes to it: who opens it waits for ever.
  std::string endless() {
    const fs::path path = folder_ / "endless.step";
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    return path.string();
  }
};

std::vector<CadCurve> line_of(double length) {
  return {{"line", std::vector<Piece>{LinePiece{{0, 0}, {length, 0}}}}};
}

double length_in(const Drawing& drawing) {
  return norm(end_point(drawing.curves.at(0).pieces.at(0)) -
              start_point(drawing.curves.at(0).pieces.at(0)));
}

TEST_F(CadIsolation, ThreadsWriteAndReadAtOnceInDifferentUnitsAndFormats) {
  struct Kind {
    CadFormat format;
    const char* units;
    double millimetres;
  };
  const Kind kinds[] = {{CadFormat::kStepAp214, "mm", 1.0},
                        {CadFormat::kIges, "in", 25.4},
                        {CadFormat::kIges, "m", 1000.0},
                        {CadFormat::kIges, "km", 1e6}};
  std::atomic<bool> done = false;
  std::thread busy([&] {  // holds the allocator's locks as often as it can
    while (!done) std::vector<std::string>(100, std::string(1000, 'x'));
  });
  std::vector<std::thread> threads;
  std::atomic<int> good = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    threads.emplace_back([&, k] {
      for (int round = 0; round < 3; ++round) {
        const double length = 1.0 + static_cast<double>(k) + 0.25 * round;
        const auto text = cad_text(line_of(length), {kinds[k].format, kinds[k].units, 0.0});
        if (!text) return;
        const auto read = read_cad(file(std::to_string(k) + "_" + std::to_string(round), *text));
        if (!read || std::abs(length_in(*read) / (length * kinds[k].millimetres) - 1.0) > 1e-12) {
          return;
        }
      }
      ++good;
    });
  }
  for (std::thread& one : threads) one.join();
  done = true;
  busy.join();
  EXPECT_EQ(good, 4);
}

TEST_F(CadIsolation, AHostWithMuchMemoryReadsAsWell) {
  const auto text = cad_text(line_of(2.0), {});
  ASSERT_TRUE(text) << to_line(text.error());
  const std::string path = file("line.step", *text);
  constexpr std::size_t kMuch = std::size_t{16} << 30;  // four times what the reader may have
  void* much =
      ::mmap(nullptr, kMuch, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(much, MAP_FAILED);
  const auto read = read_cad(path);
  ::munmap(much, kMuch);
  ASSERT_TRUE(read) << to_line(read.error());
  EXPECT_NEAR(length_in(*read), 2.0, 1e-12);
}

TEST_F(CadIsolation, NothingOfTheKernelIsInThisProcess) {
  ASSERT_TRUE(cad_text(line_of(2.0), {CadFormat::kIges, "mm", 0.0}));
  const std::string maps = text_of_file("/proc/self/maps");
  ASSERT_NE(maps.find("libc.so"), std::string::npos);
  EXPECT_EQ(maps.find("libTK"), std::string::npos);
}

TEST_F(CadIsolation, ReadingIsCancelled) {
  const auto start = SteadyClock::now();
  CadRun run;
  run.cancelled = [&] { return SteadyClock::now() - start > std::chrono::milliseconds(200); };
  const auto read = read_cad(endless(), run);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kCancelled);
  EXPECT_LT(SteadyClock::now() - start, std::chrono::seconds(20));
}

TEST_F(CadIsolation, ReadingEndsWithTheTimeItIsGiven) {
  CadRun run;
  run.seconds = 0.5;
  const std::string path = endless();
  const auto read = read_cad_surfaces(path, run);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kDamaged);
  EXPECT_EQ(read.error().where, path);
  EXPECT_NE(read.error().what.find("not done after 0.5 s"), std::string::npos);
}

/// Process number of the only child, or 0.
pid_t child_of(pid_t process) {
  const std::string number = std::to_string(process);
  return std::atoi(text_of_file("/proc/" + number + "/task/" + number + "/children").c_str());
}

/// Running, and not only waiting for its end to be noticed.
bool is_alive(pid_t process) {
  const std::string state = text_of_file("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name = state.rfind(')');
  return name != std::string::npos && state.substr(name + 2, 1) != "Z";
}

template <class Condition>
bool comes_true(Condition condition) {
  const auto start = SteadyClock::now();
  while (!condition() && SteadyClock::now() - start < std::chrono::seconds(60)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

TEST_F(CadIsolation, TheHelperEndsWhenTheProgramIsKilled) {
  const std::string path = endless();
  const pid_t program = ::fork();
  if (program == 0) {
    (void)read_cad(path);
    ::_exit(0);
  }
  pid_t helper = 0;
  const bool started = comes_true([&] { return (helper = child_of(program)) > 0; });
  // it has taken its job when it waits for the file: a second thread watches for our end
  const bool works =
      started && comes_true([&] {
        return text_of_file("/proc/" + std::to_string(helper) + "/status").find("Threads:\t2") !=
               std::string::npos;
      });
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  ASSERT_TRUE(started);
  EXPECT_TRUE(works);
  EXPECT_TRUE(comes_true([&] { return !is_alive(helper); }));
}

}  // namespace
}  // namespace obvid
