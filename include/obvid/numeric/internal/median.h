// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace obvid {

/// The middle one of some values in order, of an even number the upper one; not for none. Their
/// order changes.
inline double median_within(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double median_of(std::vector<double> values) { return median_within(values); }

}  // namespace obvid
