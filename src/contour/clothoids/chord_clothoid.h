// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace obvid::clothoids {

/// A clothoid seen from its chord: with t from -1 to 1 along it, its heading is
/// `middle + linear t + square t^2`, and the chord has heading 0.
struct ChordClothoid {
  double linear = 0.0;  ///< half the turn from start to end
  double square = 0.0;  ///< an eighth of sharpness times length squared
  double shrink = 0.0;  ///< chord over length
  bool found = false;
};

/// How `square` and `shrink` answer to the sum and the difference of the end headings.
struct ChordSlopes {
  double square_by_half_sum = 0.0;
  double square_by_linear = 0.0;
  double shrink_by_half_sum = 0.0;
  double shrink_by_linear = 0.0;
};

/// The clothoid with end headings `alpha` and `beta` against its chord, both in [-pi, pi].
[[nodiscard]] ChordClothoid solve_chord(double alpha, double beta);

/// The same with its derivatives.
[[nodiscard]] ChordClothoid solve_chord(double alpha, double beta, ChordSlopes& slopes);

}  // namespace obvid::clothoids
