// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace obvid {

/// Tick of an axis with its label (in the axis' power of ten).
struct PictureTick {
  double value = 0.0;
  std::string label;  ///< empty for a tick without label
};

/// Range of an axis with round ticks.
struct PictureAxis {
  double low = 0.0;
  double high = 1.0;
  bool logarithmic = false;
  int exponent = 0;  ///< labels are in units of 10^exponent
  std::vector<PictureTick> ticks;

  /// Place of a value on [0, 1], not clipped.
  [[nodiscard]] double place(double value) const;
};

/// Axis that starts and ends exactly at the range (arc length).
[[nodiscard]] PictureAxis tight_axis(double low, double high, int wanted_ticks);
/// Axis widened to round ticks around the range.
[[nodiscard]] PictureAxis round_axis(double low, double high, int wanted_ticks);
/// Logarithmic axis; 0 < low < high.
[[nodiscard]] PictureAxis log_axis(double low, double high);

/// Largest of 1, 2, 5 times a power of ten that does not exceed `value` > 0.
[[nodiscard]] double round_down(double value);

/// Number for reading: `digits` significant digits, no trailing zeros, powers of ten as 10^n with
/// raised figures outside 1e-4 .. 1e6.
[[nodiscard]] std::string readable_number(double value, int digits);
/// The same of a bound: rounded up.
[[nodiscard]] std::string readable_bound(double bound, int digits);

/// "", "10^-3 " with raised figures: what stands before the unit in an axis title.
[[nodiscard]] std::string power_prefix(int exponent);

}  // namespace obvid
