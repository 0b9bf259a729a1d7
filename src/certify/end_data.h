// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/curve/pieces.h"

namespace obvid {

/// Where a piece begins or ends (docs/methods/certify.md, section 5). Every figure comes with two
/// bounds. Error: how far the figure may be from that of the piece exactly as its numbers stand.
/// Rounding: how far the rounding of the stored numbers alone can have moved it.
struct EndData {
  Vec2 point;
  Vec2 rest;       ///< the exact end is point + rest, where `point_error` is 0
  Vec2 direction;  ///< of any length
  double kappa = 0.0;
  double slope = 0.0;          ///< d kappa/ds, 1/unit^2
  double point_error = 0.0;    ///< units
  double heading_error = 0.0;  ///< rad
  double kappa_error = 0.0;    ///< 1/unit
  double slope_error = 0.0;    ///< 1/unit^2
  double point_rounding = 0.0;
  double heading_rounding = 0.0;
  double kappa_rounding = 0.0;
};

struct PieceEnds {
  EndData start, end;
};

/// NaN where a piece has no direction. `slopes`: those of Bezier pieces too, which take longer than
/// all the rest.
[[nodiscard]] PieceEnds ends_of(const Piece& piece, bool slopes = false);

}  // namespace obvid
