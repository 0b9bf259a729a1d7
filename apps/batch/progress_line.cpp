// SPDX-License-Identifier: Apache-2.0
#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace obvid::batch {
namespace {

constexpr std::chrono::milliseconds kOnTerminals{500}, kElsewhere{15'000};

}  // namespace

std::string spoken_time(double seconds) {
  if (seconds < 95.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.1f} minutes", seconds / 60.0);
  return fmt::format("{:.1f} hours", seconds / 3600.0);
}

ProgressLine::ProgressLine(const Pace& pace, bool wanted)
    : pace_(pace),
      terminal_(::isatty(STDERR_FILENO) == 1),
      begin_(std::chrono::steady_clock::now()) {
  if (wanted) thread_ = std::thread([this] { watch(); });
}

ProgressLine::~ProgressLine() {
  {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  if (terminal_ && shown_) fmt::print(stderr, "\r\033[K");
}

std::string ProgressLine::text() const {
  const std::size_t done = pace_.done, all = pace_.items, failed = pace_.failed;
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin_;
  const double rate = static_cast<double>(done) / time.count();
  std::string out = fmt::format("{} of {} items ({:.1f} %), {:.3g} a second", done, all,
                                100.0 * static_cast<double>(done) / static_cast<double>(all), rate);
  if (done > 0) {
    out += fmt::format(", {} left", spoken_time(static_cast<double>(all - done) / rate));
  }
  if (failed > 0) out += fmt::format(", {} failed", failed);
  return out;
}

void ProgressLine::watch() {
  std::unique_lock lock(mutex_);
  const auto every = terminal_ ? kOnTerminals : kElsewhere;
  while (!changed_.wait_for(lock, every, [this] { return ended_; })) {
    if (pace_.items == 0) continue;
    if (terminal_) {
      fmt::print(stderr, "\r\033[Kobvid: {}", text());
    } else {
      fmt::print(stderr, "obvid: {}\n", text());
    }
    std::fflush(stderr);
    shown_ = true;
  }
}

}  // namespace obvid::batch
