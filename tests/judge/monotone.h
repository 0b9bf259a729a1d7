// SPDX-License-Identifier: Apache-2.0
// Where the curvature of a piece rises and falls, proved.
#pragma once

#include <vector>

#include "ball.h"
#include "pieces.h"

namespace judge {

/// A parameter interval in which the curvature has exactly one extremum.
struct Turn {
  double from = 0.0, to = 0.0;
};

struct CurvatureLaw {
  bool decided = false;     ///< the rest holds
  bool regular = false;     ///< weights and speed are positive on [0, 1]
  std::vector<int> signs;   ///< of d kappa / dt, in order; {0} where it is constant
  std::vector<Turn> turns;  ///< one less than signs

  [[nodiscard]] int direction() const { return signs.size() == 1 ? signs.front() : 0; }
  [[nodiscard]] bool one_way() const { return decided && regular && signs.size() == 1; }
};
CurvatureLaw curvature_law(const Piece& piece);

/// Sign of d kappa / dt of a Bezier piece at t; 2 where not even many digits decide.
int slope_sign(const Bezier& bezier, double t);

/// A polynomial as coefficients of t^j (1 - t)^(n - j), binomials included.
using Form = std::vector<Ball>;
struct Signs {
  bool decided = true;
  std::vector<int> signs;  ///< without repetitions; {0}: the zero polynomial
  std::vector<Turn> turns;
  bool touches = false;  ///< zero at a place that was met exactly
};
/// Signs of a polynomial on the open interval (0, 1).
Signs signs_of(const Form& form);

}  // namespace judge
