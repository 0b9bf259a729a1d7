// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "obvid/core/run_context.h"

namespace obvid {

/// Looks after long work: tells whoever listens how far it is, counts it, and says when to stop.
/// Work is counted in units that no machine changes (one step of a solver on one point is one), so
/// that a limit has the same result everywhere. Work that was cancelled stops in the same way; what
/// it has by then is no result, and whoever made the watch throws it away.
class Watch {
 public:
  Watch() = default;
  explicit Watch(RunContext run) : run_(std::move(run)) {}

  /// So much was done. False: stop, and make do with what there is.
  bool spend(double units) {
    spent_ += units;
    return may_go_on();
  }
  [[nodiscard]] bool may_go_on() { return spent_ < limit_ && !cancelled(); }
  /// Whether the work shall stop for good: asks, unless the answer was yes before.
  [[nodiscard]] bool cancelled() {
    if (!cancelled_ && run_.cancelled) cancelled_ = run_.cancelled();
    return cancelled_;
  }
  /// Whether that was the answer before: then what was made is worth nothing.
  [[nodiscard]] bool was_cancelled() const { return cancelled_; }
  [[nodiscard]] double spent() const { return spent_; }

  /// `done` of the present stretch, in [0, 1]. What is told never goes back.
  void tell(std::string_view stage, double done) {
    if (!run_.progress) return;
    told_ = std::max(told_, from_ + (to_ - from_) * std::clamp(done, 0.0, 1.0));
    run_.progress(stage, told_);
  }

 private:
  friend class Allowance;
  friend class ProgressShare;

  RunContext run_;
  bool cancelled_ = false;
  double spent_ = 0.0, limit_ = std::numeric_limits<double>::infinity();
  double from_ = 0.0, to_ = 1.0, told_ = 0.0;
};

/// The same of work that may have none: asks.
[[nodiscard]] inline bool is_to_end(Watch* watch) { return watch != nullptr && watch->cancelled(); }

/// Whether that was the answer before.
[[nodiscard]] inline bool has_ended(const Watch* watch) {
  return watch != nullptr && watch->was_cancelled();
}

/// While it lives, `Watch::spend` says stop after so many more units; an outer allowance that is
/// nearer its end holds as well.
class Allowance {
 public:
  Allowance(Watch& watch, double units) : watch_(watch), outer_(watch.limit_) {
    watch_.limit_ = std::min(outer_, watch_.spent_ + units);
  }
  ~Allowance() { watch_.limit_ = outer_; }
  Allowance(const Allowance&) = delete;
  Allowance& operator=(const Allowance&) = delete;

 private:
  Watch& watch_;
  double outer_;
};

/// While it lives, what is told is from `from` to `to` of the share around it.
class ProgressShare {
 public:
  ProgressShare(Watch& watch, double from, double to)
      : watch_(watch), outer_from_(watch.from_), outer_to_(watch.to_) {
    const double length = outer_to_ - outer_from_;
    watch_.from_ = outer_from_ + length * from;
    watch_.to_ = outer_from_ + length * to;
  }
  ~ProgressShare() {
    watch_.from_ = outer_from_;
    watch_.to_ = outer_to_;
  }
  ProgressShare(const ProgressShare&) = delete;
  ProgressShare& operator=(const ProgressShare&) = delete;

  /// The k-th of nobody knows how many: half of what the ones before have left.
  static ProgressShare next_of_many(Watch& watch, int k) {
    const double left = std::pow(0.5, k);
    return {watch, 1.0 - left, 1.0 - 0.5 * left};
  }

 private:
  Watch& watch_;
  double outer_from_, outer_to_;
};

}  // namespace obvid
