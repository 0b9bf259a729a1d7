// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace obvid {
namespace {

/// Numbers are handed out one after another: whoever is free takes the next.
class Share {
 public:
  Share(std::size_t count, const std::function<void(std::size_t)>& work)
      : count_(count), work_(work) {}

  void take_all() {
    for (std::size_t i = next_++; i < count_ && !failed_; i = next_++) {
      try {
        work_(i);
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (!failed_) first_ = std::current_exception();
        failed_ = true;
      }
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

}  // namespace

void in_parallel(std::size_t count, std::size_t threads,
                 const std::function<void(std::size_t)>& work) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  Share share(count, work);
  std::vector<std::thread> helpers;
  for (std::size_t k = 1; k < std::min(threads, count); ++k) {
    try {
      helpers.emplace_back([&share] { share.take_all(); });
    } catch (const std::system_error&) {
      break;  // the machine gives no more: the others do the work
    }
  }
  share.take_all();
  for (std::thread& helper : helpers) helper.join();
  share.rethrow();
}

Result<void> in_parallel(std::size_t count, std::size_t threads, const RunContext& run,
                         const std::function<void(std::size_t)>& work) {
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> stopped{false};
  in_parallel(count, threads, [&](std::size_t i) {
    if (stopped) return;
    work(i);
    if (std::this_thread::get_id() == caller && !may_go_on(run)) stopped = true;
  });
  if (stopped) return fail(cancelled_error());
  return {};
}

}  // namespace obvid
