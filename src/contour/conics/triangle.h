// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid::conics {

/// Triangle of chord and end tangents, by the angles at the chord.
struct Triangle {
  int turning = 0;     ///< +1 the curve turns left, -1 right
  double h = 0.0;      ///< chord
  double phi = 0.0;    ///< angle at the start, in (0, pi)
  double psi = 0.0;    ///< angle at the end, in (0, pi); phi + psi < pi
  double log_a = 0.0;  ///< logarithm of the side at the start
  double log_b = 0.0;  ///< of the side at the end
  Vec2 apex;           ///< relative to the start of the chord
};

/// Nothing where chord and tangents make no triangle.
[[nodiscard]] std::optional<Triangle> triangle_over(const Element& start, const Element& end);

/// Logarithms of the squared weights with which curvature is monotone: `at_start` where its rate is
/// 0 at the start, `at_end` where it is 0 at the end. |kappa| falls between them when
/// at_end < at_start, and grows when at_start < at_end. -infinity where no weight is small enough.
struct SquaredWeights {
  double at_start = 0.0;
  double at_end = 0.0;
};

[[nodiscard]] SquaredWeights monotone_squares(double phi, double psi);

/// Logarithm of |kappa| w^2 at the start and at the end.
[[nodiscard]] double log_start_curvature(const Triangle& t);
[[nodiscard]] double log_end_curvature(const Triangle& t);

[[nodiscard]] RationalBezier conic(const Element& start, const Element& end, const Triangle& t,
                                   double weight);

}  // namespace obvid::conics
