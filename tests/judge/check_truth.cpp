// SPDX-License-Identifier: Apache-2.0
// The contour against the curve that its points were taken from.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "checks.h"
#include "region.h"

namespace judge {
namespace {

/// The lower bound speaks of curves that do not turn far between neighbouring points.
constexpr Real kMostTurn = 0.7L;  // rad

/// How far the known curve turns between two parameters, to both sides together: that of chords.
Real turning(const Truth& truth, Real a, Real b) {
  constexpr int kSteps = 256;
  Real sum = 0.0L;
  Vec before{};
  for (int i = 1; i <= kSteps; ++i) {
    const Vec now = truth.at(a + (b - a) * i / kSteps) - truth.at(a + (b - a) * (i - 1) / kSteps);
    if (i > 1) sum += std::abs(std::atan2(cross(before, now), dot(before, now)));
    before = now;
  }
  return sum * (kSteps + 1) / (kSteps - 1);  // half a step is missing at both ends
}

/// The points miss the known curve by the rounding of their coordinates, and the contour the points
/// by that of its numbers: how much wider that makes what lies between the circles.
Real moved(const Course& course, const Truth& truth, std::size_t i) {
  std::array<Vec, 4> given, real;
  Real coordinate = 0.0L;
  for (std::size_t j = 0; j < 4; ++j) {
    const Point p = course.file.points[i - 1 + j];
    given[j] = seen(p, course.origin);
    real[j] = truth.at(truth.parameters[i - 1 + j]) - Vec{course.origin.x, course.origin.y};
    coordinate =
        std::max({coordinate, std::abs(static_cast<Real>(p.x)), std::abs(static_cast<Real>(p.y))});
  }
  const Lens a = Lens::of(given[0], given[1], given[2], given[3]);
  const Lens b = Lens::of(real[0], real[1], real[2], real[3]);
  const Real ends = std::abs(std::tan(0.5L * a.before) - std::tan(0.5L * b.before)) +
                    std::abs(std::tan(0.5L * a.after) - std::tan(0.5L * b.after));
  constexpr Real kUlps = 16.0L * 0x1p-52L;
  return 0.5L * a.chord * ends + a.growth() * kUlps * coordinate / a.shortest;
}

void check_distance(const Course& course, const Truth& truth, std::size_t k, double stated,
                    Sheet& sheet) {
  const Part& part = course.parts[k];
  const std::size_t i = part.from_point;
  if (i < 1 || i + 2 >= truth.parameters.size()) return;
  // the figure speaks of curves that turn by less than half a turn there
  if (!(turning(truth, truth.parameters[i - 1], truth.parameters[i + 2]) < kStraightAngle)) return;
  const Real a = truth.parameters[i], b = truth.parameters[i + 1];
  constexpr int kPlaces = 12;
  Real most = 0.0L;
  for (int j = 1; j < kPlaces; ++j) {
    const Vec p = truth.at(a + (b - a) * j / kPlaces) - Vec{course.origin.x, course.origin.y};
    most = std::max(most, course.path.nearest(p, part.from, part.to).distance);
  }
  const Real slack = 16.0L * course.resolution() + moved(course, truth, i);
  sheet.expect(most <= static_cast<Real>(stated) * (1.0L + 1e-6L) + slack,
               "segments.points_only_error truth", stated, most,
               fmt::format("points {}-{}: distance of the known curve", i + 1, i + 2));
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
