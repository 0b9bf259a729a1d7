// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "obvid/contour/bsplines.h"
#include "obvid/contour/common/internal/carried_parts.h"

namespace obvid::contour_detail {
namespace {

/// Points on one line, as far as their coordinates tell, each ahead of the one before.
bool straight(const std::vector<Vec2>& points) {
  constexpr double kRounding = 0x1p-50;  // of the largest coordinate: its last digits
  double largest = 0.0;
  for (const Vec2 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const Vec2 chord = points.back() - points.front();
  const Vec2 along = chord / norm(chord);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(dot(along, points[i] - points[i - 1]) > 0.0)) return false;
    if (std::abs(cross(along, points[i] - points.front())) > kRounding * largest) return false;
  }
  return true;
}

/// The spline through points of one line: that line.
Carried baseline_of_lines(const std::vector<Vec2>& points,
                          const std::vector<std::optional<std::size_t>>& source) {
  Carried out;
  out.contour.carrier = Carrier::kBaseline;
  const double theta = heading(points.back() - points.front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.contour.joints.push_back({{points[i], theta, 0.0}, source[i], {}});
    if (i > 0) out.contour.pieces.emplace_back(LinePiece{points[i - 1], points[i]});
  }
  return out;
}

}  // namespace

Result<Carried> carry_baseline(const Contour& spirals, const CarryOptions& options) {
  std::vector<Vec2> points;
  std::vector<std::optional<std::size_t>> source;
  for (const Joint& joint : spirals.joints) {
    points.push_back(joint.element.point);
    source.push_back(joint.source);
  }
  const bool clamped = !options.loop && (options.start_heading || options.end_heading);
  if (!options.loop && !clamped && straight(points)) return baseline_of_lines(points, source);
  CubicSplineOptions how;
  std::vector<Vec2> through = points;
  if (options.loop) {
    how.end = SplineEnd::kPeriodic;
    through.pop_back();
  }
  auto spline = cubic_spline(through, how);
  if (spline && clamped) {  // an end without a heading keeps the slope that it has by itself
    how.end = SplineEnd::kTangents;
    how.start_slope = options.start_heading ? unit_at(*options.start_heading) : spline->slopes.front();
    how.end_slope = options.end_heading ? unit_at(*options.end_heading) : spline->slopes.back();
    spline = cubic_spline(through, how);
  }
  OBVID_TRY(spline);
  Carried out;
  out.contour.carrier = Carrier::kBaseline;
  double theta = 0.0;
  const std::vector<RationalBezier> pieces = bezier_pieces(*spline);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Element e = element_near(Piece{pieces[i]}, 0.0, theta);
    theta = e.theta;
    out.contour.joints.push_back({{points[i], e.theta, e.kappa}, source[i], {}});
    out.contour.pieces.emplace_back(pieces[i]);
  }
  const Element end = element_near(out.contour.pieces.back(), 1.0, theta);
  out.contour.joints.push_back({{points.back(), end.theta, end.kappa}, source.back(), {}});
  return out;
}

}  // namespace obvid::contour_detail
