// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "obvid/curve/nurbs.h"

namespace obvid {

/// One coefficient of the Bezier form of a spline as a mean of its control points.
struct BezierRow {
  std::size_t first = 0;  ///< control point of the first weight
  std::array<double, kMaxNurbsDegree + 1> weight{};
};

/// All spans of one direction in Bezier form: span s has rows s * degree .. (s + 1) * degree, so
/// that neighbours share the row between them and get the same bits from it.
struct BezierRows {
  int degree = 0;
  std::vector<double> knots;  ///< ends of the spans, one more than these
  std::vector<BezierRow> rows;

  [[nodiscard]] std::size_t spans() const { return knots.size() - 1; }
  /// Parameter at a share of a span.
  [[nodiscard]] double at(std::size_t span, double share) const {
    return Range{knots[span], knots[span + 1]}.at(share);
  }
};

/// Knots clamped, as `check` accepts them.
[[nodiscard]] BezierRows bezier_rows(int degree, const std::vector<double>& knots);

}  // namespace obvid
