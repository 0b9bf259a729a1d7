// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace obvid {

/// R. Franke (1979), his first test function: for [0, 1] x [0, 1].
inline double franke(double x, double y) {
  const auto square = [](double a) { return a * a; };
  return 0.75 * std::exp(-(square(9 * x - 2) + square(9 * y - 2)) / 4) +
         0.75 * std::exp(-square(9 * x + 1) / 49 - (9 * y + 1) / 10) +
         0.5 * std::exp(-(square(9 * x - 7) + square(9 * y - 3)) / 4) -
         0.2 * std::exp(-square(9 * x - 4) - square(9 * y - 7));
}

}  // namespace obvid
