// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

namespace obvid {

/// The same on every system, which std::uniform_real_distribution is not.
inline double uniform(std::mt19937_64& rng, double low, double high) {
  return low + (high - low) * (static_cast<double>(rng() >> 11) * 0x1p-53);
}

}  // namespace obvid
