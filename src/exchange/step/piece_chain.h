// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <variant>
#include <vector>

#include "obvid/exchange/internal/cad_curve.h"

namespace obvid::exchange {

/// start + t direction, t from 0 to `length`.
struct StepLine {
  Vec2 direction;
  double length = 0.0;
};

/// centre + major cos(E) axis + minor sin(E) (axis turned by a right angle, to the left when
/// `left`), E from `from` up to `to`. A circle when major is minor.
struct StepConic {
  Vec2 centre, axis;
  double major = 0.0, minor = 0.0;
  double from = 0.0, to = 0.0;
  bool left = true;
};

/// A piece as STEP has it.
struct StepShape {
  std::variant<StepLine, StepConic, NurbsCurve> curve;
  Vec2 start, end;
};

/// A curve of pieces that meet.
struct StepChain {
  std::vector<StepShape> shapes;
  bool closed = false;
};

/// Lengths times `scale`. Points nearer than `same` (units of the file) are one. Errors: E303 a
/// number that is not finite, E304 no pieces, E310 a clothoid, E101 lists that make no NURBS
/// curve, pieces that do not meet.
[[nodiscard]] Result<StepChain> step_chain(const CadCurve& curve, double scale, double same);

}  // namespace obvid::exchange
