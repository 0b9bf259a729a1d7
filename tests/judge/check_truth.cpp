// SPDX-License-Identifier: Apache-2.0
// The contour against the curve that its points were taken from.
#include <fmt/format.h>

#include <algorithm>

#include "checks.h"

namespace judge {
namespace {

/// The lower bound speaks of curves that do not turn far between neighbouring points.
constexpr Real kMostTurn = 0.7L;  // rad

void check_distance(const Course& course, const Truth& truth, std::size_t k, double stated,
                    Sheet& sheet) {
  const Part& part = course.parts[k];
  const Real a = truth.parameters[part.from_point], b = truth.parameters[part.to_point];
  constexpr int kPlaces = 12;
  Real most = 0.0L;
  for (int i = 1; i < kPlaces; ++i) {
    const Vec p = truth.at(a + (b - a) * i / kPlaces) - Vec{course.origin.x, course.origin.y};
    most = std::max(most, course.path.nearest(p, part.from, part.to).distance);
  }
  // the points themselves miss the curve by their rounding
  const Real slack = 16.0L * course.resolution();
  sheet.expect(most <= static_cast<Real>(stated) * (1.0L + 1e-6L) + slack,
               "segments.points_only_error truth", stated, most,
               fmt::format("points {}-{}: distance of the known curve", part.from_point + 1,
                           part.to_point + 1));
}

}  // namespace

void check_truth(const Course& course, const Input& input, Sheet& sheet) {
  if (!input.truth || input.points.size() != course.file.points.size()) return;
  const Truth& truth = *input.truth;
  if (truth.parameters.size() != input.points.size() || course.file.closed) return;
  const Json& rows = member(course.file.report, "segments");
  if (truth.monotone && rows.is_array() && rows.size() == course.parts.size()) {
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Figure stated = figure(rows[k], "points_only_error");
      if (stated.known()) check_distance(course, truth, k, *stated.value, sheet);
    }
  }
  const Figure bound = figure(course.file.report, "vertices_lower_bound");
  // where points are met exactly, the rounding of their coordinates is not on the curve
  const bool within = !course.file.tolerance.empty();
  if (bound.known() && within && truth.largest_turn < kMostTurn) {
    sheet.expect(*bound.value <= truth.vertices, "report.vertices_lower_bound truth", *bound.value,
                 truth.vertices, "vertices of the known curve");
  }
}

}  // namespace judge
