// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "obvid/core/result.h"
#include "obvid/core/run_context.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/report/curve_comparison.h"

namespace obvid::pipeline_detail {

/// From coordinates of one curve to those of another: turned, scaled and moved.
struct Similarity {
  Vec2 from, to;
  Vec2 turn{1.0, 0.0};  ///< cosine and sine
  double scale = 1.0;

  [[nodiscard]] Vec2 vector(Vec2 v) const { return complex_product(turn, v); }
  [[nodiscard]] Vec2 point(Vec2 p) const { return to + scale * vector(p - from); }
  /// The point that `point` takes there.
  [[nodiscard]] Vec2 back(Vec2 p) const {
    return from + complex_product({turn.x, -turn.y}, p - to) / scale;
  }
};

/// The first of the curves, and how places on it are told.
struct FirstCurve {
  const ContourPath& path;
  double sign = 1.0;  ///< -1: what lies to the right counts as positive
  const AirfoilFigures* airfoil = nullptr;
};

/// How far the pieces are from the first curve, whose places `to_other` takes to theirs.
/// Errors: E103.
[[nodiscard]] Result<CurveDeviation> deviation_from(const FirstCurve& first,
                                                    std::span<const Piece> other,
                                                    const Similarity& to_other,
                                                    const RunContext& run);

}  // namespace obvid::pipeline_detail
