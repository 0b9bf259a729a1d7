// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "obvid/core/result.h"
#include "obvid/exchange/drawing.h"
#include "promise.h"

namespace obvid {

/// What every reader of drawings keeps, whatever it was given.
inline void require_promises(const Result<Drawing>& drawing) {
  if (!drawing) {
    require(exit_code(drawing.error().code) == 3);
    require(!drawing.error().what.empty() && !drawing.error().where.empty());
    return;
  }
  require(!drawing->curves.empty() || !drawing->series.empty());
  for (const DrawnCurve& curve : drawing->curves) {
    require(!curve.pieces.empty() && !curve.label.empty());
    for (const Piece& piece : curve.pieces) {
      require(is_finite(start_point(piece)) && is_finite(end_point(piece)));
    }
    if (curve.closed) {
      require(start_point(curve.pieces.front()) == end_point(curve.pieces.back()));
    }
  }
  for (const PointSeries& series : drawing->series) {
    require(!series.points.empty() && !series.units.name.empty());
    for (const Vec2 p : series.points) require(is_finite(p));
  }
}

}  // namespace obvid
