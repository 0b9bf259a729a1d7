// SPDX-License-Identifier: Apache-2.0
#include "check_lines.h"

#include <algorithm>
#include <cmath>

#include "obvid/curve/internal/basis.h"

namespace obvid {
namespace {

constexpr int kLineSamplesPerSpan = 8;
constexpr double kCurvatureRounding = 1e-6;  ///< of a line's largest curvature

/// Signed curvature at samples along a curve; empty for a curve that stands still.
std::vector<double> curvatures(const SpaceCurve& curve) {
  std::vector<Vec3> binormal;
  const std::vector<double> knots = distinct(curve.knots);
  Vec3 mean;
  std::vector<double> values;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double step = (knots[i + 1] - knots[i]) / kLineSamplesPerSpan;
    for (int k = 0; k < kLineSamplesPerSpan; ++k) {
      const SpaceJet jet = evaluate(curve, knots[i] + (k + 0.5) * step);
      const double speed = norm(jet.d1);
      if (!(speed > 0.0)) continue;
      binormal.push_back(cross(jet.d1 / speed, jet.d2 / speed) / speed);
      // the curve's mean plane, whichever way it bends
      const Vec3 b = binormal.back();
      mean = mean + (dot(mean, b) < 0.0 ? -b : b);
    }
  }
  for (const Vec3& b : binormal) values.push_back(dot(b, mean) < 0.0 ? -norm(b) : norm(b));
  return values;
}

/// A side of a patch that ends in a point is a line of rounding, which has no shape.
bool shrinks_to_a_point(const SpaceCurve& curve, double size) {
  constexpr double kPoint = 1e-9;      // of the model's size
  constexpr double kRounding = 1e-12;  // of the coordinates: files have twelve digits or more
  double coordinate = 0.0, extent = 0.0;
  for (const Vec3& p : curve.points) {
    coordinate = std::max({coordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    extent = std::max(extent, norm(p - curve.points.front()));
  }
  return extent <= std::max(kPoint * size, kRounding * coordinate);
}

/// Extrema that stand out by more than `least` on both sides.
std::size_t extrema(const std::vector<double>& values, double least) {
  std::size_t count = 0;
  int direction = 0;
  double low = values.front(), high = values.front();
  for (const double value : values) {
    low = direction >= 0 ? std::min(low, value) : low;
    if (direction == 0) {
      high = std::max(high, value);
      if (value > low + least) direction = 1;
      if (value < high - least) direction = -1;
      if (direction != 0) low = high = value;
    } else if (direction > 0) {
      high = std::max(high, value);
      if (value < high - least) {
        ++count;
        direction = -1;
        low = value;
      }
    } else {
      low = std::min(low, value);
      if (value > low + least) {
        ++count;
        direction = 1;
        high = value;
      }
    }
  }
  return count;
}

std::size_t sign_changes(const std::vector<double>& values, double least) {
  std::size_t count = 0;
  int last = 0;
  for (const double value : values) {
    const int sign = value > least ? 1 : value < -least ? -1 : 0;
    if (sign != 0 && last != 0 && sign != last) ++count;
    if (sign != 0) last = sign;
  }
  return count;
}

}  // namespace

Result<LineReport> check_lines(const NurbsSurface& surface, std::size_t lines,
                               const RunContext& run) {
  LineReport report;
  const Range range = domain_v(surface);
  const double size = size_of(surface);
  for (std::size_t j = 0; j < lines; ++j) {
    OBVID_TRY(may_go_on(run));
    const double v =
        range.at(lines > 1 ? static_cast<double>(j) / static_cast<double>(lines - 1) : 0.5);
    const SpaceCurve line = isocurve_at_v(surface, v);
    if (shrinks_to_a_point(line, size)) continue;
    const std::vector<double> values = curvatures(line);
    if (values.empty()) continue;
    constexpr double kNoSize = 1e-300;               // units: below it nothing can be divided by
    double largest = 1.0 / std::max(size, kNoSize);  // flatter than the model is large: straight
    for (const double value : values) largest = std::max(largest, std::abs(value));
    const std::size_t vertices = extrema(values, kCurvatureRounding * largest);
    ++report.lines;
    report.monotone += vertices == 0 ? 1 : 0;
    report.vertices += vertices;
    report.most_vertices = std::max(report.most_vertices, vertices);
    report.inflections += sign_changes(values, kCurvatureRounding * largest);
  }
  return report;
}

}  // namespace obvid
