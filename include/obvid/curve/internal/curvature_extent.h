// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "obvid/curve/pieces.h"

namespace obvid {

/// Least and largest signed curvature, 1/unit.
struct CurvatureExtent {
  double least = 0.0;
  double largest = 0.0;
};

/// Finite curvatures of a piece at the parameters `at` (ascending from 0 to 1, two at least),
/// widened by what is found between them: beside the least and the largest one, and beside the
/// slowest place of a piece that nearly stops, where peaks are narrow. No bound: a peak elsewhere
/// between two parameters is not seen. Peaks smaller than half of `known` are not looked for. Cost
/// O(at.size()).
[[nodiscard]] CurvatureExtent curvature_extent(const Piece& piece, const std::vector<double>& at,
                                               double known = 0.0);

}  // namespace obvid
