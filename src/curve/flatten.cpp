// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/flatten.h"

#include <algorithm>
#include <cmath>

namespace obvid {

double largest_sagitta(const Piece& piece, int steps, double enough) {
  double most = 0.0;
  Vec2 before = start_point(piece);
  for (int k = 1; k <= steps && most <= enough; ++k) {
    const Vec2 here = evaluate(piece, static_cast<double>(k) / steps).point;
    const Vec2 middle = evaluate(piece, (k - 0.5) / steps).point, chord = here - before;
    const double length = norm(chord);
    most = std::max(most, length > 0.0 ? std::abs(cross(chord, middle - before)) / length
                                       : norm(middle - before));
    before = here;
  }
  return most;
}

int chord_steps(const Piece& piece, double tolerance, int fewest, int most) {
  int steps = fewest;
  while (steps < most && largest_sagitta(piece, steps, tolerance) > tolerance) steps *= 2;
  return steps;
}

}  // namespace obvid
