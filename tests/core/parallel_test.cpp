// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

namespace obvid {
namespace {

using namespace std::chrono_literals;

TEST(InParallel, DoesEachNumberOnce) {
  for (const std::size_t threads : {0U, 1U, 2U, 7U}) {
    std::vector<int> done(100, 0);
    in_parallel(done.size(), threads, [&](std::size_t i) { ++done[i]; });
    EXPECT_EQ(done, std::vector<int>(100, 1));
    std::vector<int> again(100, 0);
    const RunContext asked{Progress{}, [] { return false; }};
    const auto whole = in_parallel(again.size(), with_threads(asked, threads),
                                   [&](std::size_t i, const RunContext& run) {
                                     if (may_go_on(run)) ++again[i];
                                   });
    EXPECT_TRUE(whole);
    EXPECT_EQ(again, std::vector<int>(100, 1));
  }
}

#ifdef __linux__
// As many threads as the process may run at a time, not as the machine has: `taskset -c 0` is one.
TEST(InParallel, OfAProcessBoundToOneProcessorTheCallerDoesAll) {
  std::thread([] {
    cpu_set_t all, one;
    ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
    int first = 0;
    while (!CPU_ISSET(first, &all)) ++first;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> elsewhere{0};
    in_parallel(50, 0, [&](std::size_t) {
      if (std::this_thread::get_id() != caller) ++elsewhere;
      std::this_thread::sleep_for(100us);  // so that others would come to it
    });
    EXPECT_EQ(elsewhere, 0);
  }).join();
}
#endif

TEST(InParallel, PartsShareTheThreadsThatThereAre) {
  const auto of_parts = [](std::size_t count, RunContext run) {
    std::vector<std::size_t> threads(count);
    EXPECT_TRUE(in_parallel(count, run, [&](std::size_t i, const RunContext& own) {
      threads[i] = own.threads;
    }));
    return threads;
  };
  const RunContext asked{Progress{}, [] { return false; }};
  for (const RunContext& run : {RunContext{}, asked}) {
    EXPECT_EQ(of_parts(2, with_threads(run, 6)), std::vector<std::size_t>(2, 3));
    EXPECT_EQ(of_parts(5, with_threads(run, 3)), std::vector<std::size_t>(5, 1));
    EXPECT_EQ(of_parts(1, with_threads(run, 4)), std::vector<std::size_t>(1, 4));
  }
}

TEST(InParallel, NobodyAsksWhereNobodyMayStop) {
  bool asks = false;
  EXPECT_TRUE(in_parallel(3, with_threads({}, 1), [&](std::size_t, const RunContext& run) {
    asks = asks || run.cancelled || run.progress;
  }));
  EXPECT_FALSE(asks);
}

/// The yes of the caller reaches work on other threads in its middle, though the caller has none
/// left itself; after a yes it is not asked again.
TEST(InParallel, StopsWorkOnOtherThreadsInItsMiddle) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> begun{0};
  int questions_after_yes = 0;
  bool said = false;
  const RunContext run{Progress{}, [&] {
                         if (said) ++questions_after_yes;
                         said = said || begun == 2;  // the other thread works
                         return said;
                       }};
  const auto begin = std::chrono::steady_clock::now();
  const auto ended = in_parallel(2, with_threads(run, 2), [&](std::size_t, const RunContext& mine) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
    if (std::this_thread::get_id() == caller) return;
    while (may_go_on(mine) && std::chrono::steady_clock::now() - begin < 60s) {
      std::this_thread::sleep_for(1ms);
    }
  });
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::kCancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 30s);
  EXPECT_EQ(questions_after_yes, 0);
}

TEST(InParallel, ACancelledRunDoesNothingMore) {
  std::atomic<int> done{0};
  const RunContext run{Progress{}, [] { return true; }};
  EXPECT_FALSE(in_parallel(1000, with_threads(run, 1), [&](std::size_t) { ++done; }));
  EXPECT_EQ(done, 1);  // it asks after the first
}

TEST(InParallel, ThrowsWhatItsWorkThrows) {
  const RunContext run{Progress{}, [] { return false; }};
  for (const std::size_t threads : {1U, 3U}) {
    const auto broken = [](std::size_t i) {
      if (i == 5) throw std::runtime_error("five");
    };
    EXPECT_THROW(in_parallel(50, threads, broken), std::runtime_error);
    EXPECT_THROW((void)in_parallel(50, with_threads(run, threads), broken), std::runtime_error);
  }
  const RunContext asks{Progress{}, []() -> bool { throw std::runtime_error("asked"); }};
  EXPECT_THROW((void)in_parallel(50, with_threads(asks, 2), [](std::size_t) {}),
               std::runtime_error);
}

}  // namespace
}  // namespace obvid
