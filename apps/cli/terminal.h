// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "obvid/core/error.h"
#include "obvid/core/internal/progress.h"
#include "obvid/core/result.h"

namespace obvid {

/// Colours only on terminals and only where NO_COLOR is unset.
[[nodiscard]] std::string good(std::string_view text);
[[nodiscard]] std::string bad(std::string_view text);
[[nodiscard]] std::string bold(std::string_view text);

/// Writes to standard output. Error: E102 (full disk behind a redirection, for example).
[[nodiscard]] Result<void> put(std::string_view text);

/// Prints the one line of an error to stderr and returns its exit code.
int report(const Error& error);

/// Prints each warning as one line to stderr.
void warn(const std::vector<std::string>& warnings);

/// Bar on stderr, drawn when stderr is a terminal, once work takes longer than half a second.
/// A thread of its own draws it, so that it appears even inside a long stage.
class ProgressBar {
 public:
  explicit ProgressBar(bool wanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  /// Says what is being done, and how much of it in [0, 1].
  void tell(std::string_view stage, double fraction);
  /// What the library calls; empty when there is nobody to watch.
  [[nodiscard]] Progress progress();
  /// Removes the bar from the screen for good.
  void clear();

 private:
  void watch();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::string stage_;
  double fraction_ = 0.0;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace obvid
