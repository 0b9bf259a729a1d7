// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace obvid {

/// Largest fall of curvature against the direction in which the contour's own curvature changes.
class RippleMeter {
 public:
  /// `rounding`: what rounding may have made of either curvature there (`curvature_rounding`). What
  /// is nowhere known to be bent has no runs to lose.
  void add(double wanted, double found, double rounding = 0.0) {
    largest_ = std::max(largest_, std::abs(wanted));
    bent_ = bent_ || std::abs(wanted) > rounding || std::abs(found) > rounding;
    if (any_) {
      const double change = wanted - wanted_;
      const int direction = change > 0.0 ? 1 : change < 0.0 ? -1 : direction_;
      if (direction != direction_) extreme_ = found_;
      direction_ = direction;
      extreme_ = direction > 0 ? std::max(extreme_, found) : std::min(extreme_, found);
      if (direction != 0) worst_ = std::max(worst_, std::abs(extreme_ - found));
    } else {
      extreme_ = found;
    }
    any_ = true;
    wanted_ = wanted;
    found_ = found;
  }
  [[nodiscard]] double ripple() const { return bent_ && largest_ > 0.0 ? worst_ / largest_ : 0.0; }

 private:
  bool any_ = false, bent_ = false;
  int direction_ = 0;
  double wanted_ = 0.0, found_ = 0.0, extreme_ = 0.0, worst_ = 0.0, largest_ = 0.0;
};

}  // namespace obvid
