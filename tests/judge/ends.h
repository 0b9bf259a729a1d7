// SPDX-License-Identifier: Apache-2.0
// Point, tangent and curvature of a piece at its ends, proved.
#pragma once

#include "ball.h"
#include "pieces.h"

namespace judge {

struct End {
  BallVec point;
  BallVec tangent;  ///< of any length
  Ball kappa;
  Ball slope{};  ///< d kappa/ds
};

End start_of(const Piece& piece);
/// d kappa/ds at a parameter of a piece, 0 <= t <= 1.
Ball slope_at(const Piece& piece, double t);
/// Where the numbers of the piece lead; for arcs and clothoids not the stored `end`.
End end_of(const Piece& piece);
/// Angle from one tangent to another, between -pi and pi.
Ball angle_between(const BallVec& from, const BallVec& to);
/// Angle by which an arc, clothoid or line turns.
Ball turning_of(const Clothoid& clothoid);

}  // namespace judge
