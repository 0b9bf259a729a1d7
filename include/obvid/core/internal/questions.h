// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "obvid/core/internal/watch.h"

namespace obvid {

/// Asks a watch once for so many items of a loop: one item takes less time than the answer.
class Questions {
 public:
  /// `watch` may be none, and must outlive this.
  explicit Questions(Watch* watch, std::size_t items = 256) : watch_(watch), items_(items) {}

  /// Of one item: whether the loop is to end. What it has made is then worth nothing.
  [[nodiscard]] bool end() {
    return has_ended(watch_) || (++seen_ % items_ == 0 && is_to_end(watch_));
  }

 private:
  Watch* watch_;
  std::size_t items_, seen_ = 0;
};

}  // namespace obvid
