// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid {

/// Two places between which a condition ends: it holds at one, and not at the other.
struct EndOfCondition {
  double holds = 0.0;
  double fails = 0.0;

  [[nodiscard]] double middle() const { return 0.5 * (holds + fails); }
};

/// More than take places of like size to neighbouring doubles.
inline constexpr int kHalvingsOfDoubles = 200;

/// Narrows that by halving, down to neighbouring doubles or as often as `most` says.
template <class Condition>
[[nodiscard]] EndOfCondition end_of_condition(double holds, double fails,
                                              const Condition& condition,
                                              int most = kHalvingsOfDoubles) {
  EndOfCondition out{holds, fails};
  for (int k = 0; k < most; ++k) {
    const double middle = out.middle();
    if (middle == out.holds || middle == out.fails) break;
    (condition(middle) ? out.holds : out.fails) = middle;
  }
  return out;
}

}  // namespace obvid
