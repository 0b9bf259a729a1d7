// SPDX-License-Identifier: Apache-2.0
// Splines that a drawing has by their points alone: docs/methods/dxf.md, section 3.
#include "obvid/pipeline/internal/through_points.h"

#include <algorithm>
#include <utility>

#include "obvid/contour/bsplines.h"

namespace obvid {
namespace {

std::vector<Vec2> without_repeats(const std::vector<Vec2>& points) {
  std::vector<Vec2> out = points;
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Result<CubicSpline> with_slopes(const std::vector<Vec2>& points, Vec2 start, Vec2 end) {
  return cubic_spline(points, {SplineParameter::kChord, SplineEnd::kTangents, start, end});
}

/// One direction given, at the start, and no second derivative at the other end: that is the sum
/// of a part without and one in proportion to the slope there, alike in x and in y.
Result<CubicSpline> natural_at_the_end(const std::vector<Vec2>& points, Vec2 start) {
  const auto second_at_end = [&](Vec2 end) -> Result<Vec2> {
    const auto spline = with_slopes(points, start, end);
    OBVID_TRY(spline);
    return evaluate(*spline, spline->knots.back()).d2;
  };
  const auto without = second_at_end({0.0, 0.0}), with = second_at_end({1.0, 1.0});
  OBVID_TRY(without);
  OBVID_TRY(with);
  const Vec2 rate = *with - *without;
  return with_slopes(points, start, {-without->x / rate.x, -without->y / rate.y});
}

Result<CubicSpline> open_spline(const std::vector<Vec2>& points, const ThroughPoints& ends) {
  if (ends.start && ends.end) return with_slopes(points, *ends.start, *ends.end);
  if (!ends.start && !ends.end) {
    CubicSplineOptions options;
    options.end = SplineEnd::kNatural;
    return cubic_spline(points, options);
  }
  if (ends.start) return natural_at_the_end(points, *ends.start);
  std::vector<Vec2> back(points.rbegin(), points.rend());
  auto out = natural_at_the_end(back, -*ends.end);
  OBVID_TRY(out);
  std::reverse(out->points.begin(), out->points.end());
  std::reverse(out->slopes.begin(), out->slopes.end());
  for (Vec2& slope : out->slopes) slope = -slope;
  const double last = out->knots.back();
  std::reverse(out->knots.begin(), out->knots.end());
  for (double& knot : out->knots) knot = last - knot;
  return out;
}

}  // namespace

Result<DrawnCurve> spline_through(const PointSeries& series) {
  const ThroughPoints ends = series.spline.value_or(ThroughPoints{series.name});
  std::vector<Vec2> points = without_repeats(series.points);
  DrawnCurve out;
  out.label = ends.label;
  out.layer = series.layer;
  out.closed = points.size() > 3 && points.front() == points.back();
  Result<CubicSpline> spline = CubicSpline{};
  if (out.closed) {
    points.pop_back();
    CubicSplineOptions options;
    options.end = SplineEnd::kPeriodic;
    spline = cubic_spline(points, options);
  } else {
    spline = open_spline(points, ends);
  }
  OBVID_TRY(spline);
  for (RationalBezier& piece : bezier_pieces(*spline)) out.pieces.emplace_back(std::move(piece));
  return out;
}

}  // namespace obvid
