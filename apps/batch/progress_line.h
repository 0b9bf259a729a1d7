// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "work.h"

namespace obvid::batch {

/// Tells on standard error how far a batch is, how fast it goes and how long it takes yet: on
/// terminals all the time, elsewhere a line every quarter of a minute.
class ProgressLine {
 public:
  ProgressLine(const Pace& pace, bool wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

 private:
  void watch();
  [[nodiscard]] std::string text() const;

  const Pace& pace_;
  bool terminal_;
  std::chrono::steady_clock::time_point begin_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false, shown_ = false;
  std::thread thread_;
};

/// "5.7 minutes", as people say it.
[[nodiscard]] std::string spoken_time(double seconds);

}  // namespace obvid::batch
