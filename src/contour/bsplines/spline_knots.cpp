// SPDX-License-Identifier: Apache-2.0
#include "spline_knots.h"

#include <cmath>
#include <string>

namespace obvid::bsplines {

Result<std::vector<double>> spline_knots(const std::vector<Vec2>& points, SplineParameter parameter,
                                         std::size_t fewest) {
  if (points.size() < fewest) {
    return error(ErrorCode::kTooFewPoints,
                 "the spline needs at least " + std::to_string(fewest) + " points")
        .hint("add points")
        .value(static_cast<double>(points.size()));
  }
  std::vector<double> knots(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double h = norm(points[i] - points[i - 1]);
    knots[i] = knots[i - 1] + (parameter == SplineParameter::kChord ? h : std::sqrt(h));
    if (!(knots[i] > knots[i - 1] && std::isfinite(knots[i]))) {
      return error(ErrorCode::kOutOfOrder, "two neighbouring points coincide")
          .where("point " + std::to_string(i + 1))
          .hint("remove one of them")
          .point(i)
          .value(h);
    }
  }
  return knots;
}

}  // namespace obvid::bsplines
