// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#ifdef __linux__
#include <sched.h>
#endif

namespace obvid {

std::size_t processors() {
#ifdef __linux__
  cpu_set_t own;
  if (sched_getaffinity(0, sizeof own, &own) == 0) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(CPU_COUNT(&own)));
  }
#endif
  return std::max(1U, std::thread::hardware_concurrency());
}

namespace {

/// Numbers are handed out one after another: whoever is free takes the next.
class Share {
 public:
  Share(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  void take_all() {
    for (std::size_t i = next_++; i < count_ && !failed_; i = next_++) {
      guarded([&] { work_(i); });
    }
  }

  /// What it throws is kept, and ends the work of all.
  template <class Call>
  void guarded(const Call& call) {
    try {
      call();
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (!failed_) first_ = std::current_exception();
      failed_ = true;
    }
  }

  void rethrow() const {
    if (first_) std::rethrow_exception(first_);
  }

 private:
  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex mutex_;
  std::exception_ptr first_;
};

/// Between two questions of the thread that waits for others.
constexpr std::chrono::milliseconds kBetweenQuestions{5};

/// `meanwhile`, unless empty, is called again and again while others are still at work.
void shared_out(std::size_t count, std::size_t threads,
                const std::function<void(std::size_t)>& work,
                const std::function<void()>& meanwhile) {
  if (threads == 0) threads = processors();
  Share share(count, work);
  std::vector<std::thread> helpers;
  std::mutex mutex;
  std::condition_variable one_ended;
  std::size_t ended = 0;
  for (std::size_t k = 1; k < std::min(threads, count); ++k) {
    try {
      helpers.emplace_back([&] {
        share.take_all();
        const std::scoped_lock lock(mutex);
        ++ended;
        one_ended.notify_one();
      });
    } catch (const std::system_error&) {
      break;  // the machine gives no more: the others do the work
    }
  }
  share.take_all();
  if (meanwhile) {
    std::unique_lock lock(mutex);
    while (ended < helpers.size()) {
      one_ended.wait_for(lock, kBetweenQuestions);
      lock.unlock();
      share.guarded(meanwhile);
      lock.lock();
    }
  }
  for (std::thread& helper : helpers) helper.join();
  share.rethrow();
}

}  // namespace

void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work) {
  shared_out(count, threads, work, {});
}

void in_lots(std::size_t count, std::size_t together, std::size_t threads,
             const std::function<void(std::size_t, std::size_t)>& work) {
  in_parallel((count + together - 1) / together, threads, [&](std::size_t lot) {
    work(lot * together, std::min(count, (lot + 1) * together));
  });
}

Result<void> in_parallel(std::size_t count, const RunContext& run,
                         const std::function<void(std::size_t, const RunContext&)>& work) {
  const std::size_t threads = run.threads == 0 ? processors() : run.threads;
  const std::size_t each = std::max<std::size_t>(1, threads / std::max<std::size_t>(1, count));
  if (!run.cancelled) {
    const RunContext alone = with_threads({}, each);
    in_parallel(count, threads, [&](std::size_t i) { work(i, alone); });
    return {};
  }
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> stopped{false};
  const auto ask = [&] {
    if (!stopped && run.cancelled()) stopped = true;
    return stopped.load();
  };
  const RunContext asking = with_threads({Progress{}, ask}, each);
  const RunContext told = with_threads({Progress{}, [&] { return stopped.load(); }}, each);
  const auto one = [&](std::size_t i) {
    if (stopped) return;
    const bool here = std::this_thread::get_id() == caller;
    work(i, here ? asking : told);
    if (here) ask();
  };
  shared_out(count, threads, one, ask);
  if (stopped) return fail(cancelled_error());
  return {};
}

Result<void> in_parallel(std::size_t count, const RunContext& run,
                         const std::function<void(std::size_t)>& work) {
  return in_parallel(count, run, [&](std::size_t i, const RunContext&) { work(i); });
}

Result<void> in_lots(std::size_t count, std::size_t together, const RunContext& run,
                     const std::function<void(std::size_t, std::size_t)>& work) {
  return in_parallel((count + together - 1) / together, run, [&](std::size_t lot) {
    work(lot * together, std::min(count, (lot + 1) * together));
  });
}

RunContext with_threads(RunContext run, std::size_t threads) {
  if (threads != 0) run.threads = threads;
  return run;
}

}  // namespace obvid
