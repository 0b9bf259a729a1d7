// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/coarse_polygon.h"

#include <algorithm>
#include <cmath>

#include "obvid/core/units.h"
#include "obvid/numeric/internal/median.h"

namespace obvid {
namespace {

/// Curves are given by more than eight points to the turn, polygons mostly by fewer.
constexpr double kCoarseTurn = 40.0 * kOneDegree;
/// Turn that the rounding of doubles gives points in line, rad.
constexpr double kInLine = 1e-6;
/// Errors of the points turn longer chords by less than a quarter of a right angle.
constexpr double kChordPerTolerance = 8.0;
/// So many circles through three neighbours whose curvature only grows, or only falls, are a
/// spiral: corners of polygons come in no such order.
constexpr std::size_t kCirclesOfASpiral = 5;

double curvature_through(Vec2 a, Vec2 b, Vec2 c) {
  return 2.0 * cross(b - a, c - b) / (norm(b - a) * norm(c - b) * norm(c - a));
}

bool is_spiral(const std::vector<Vec2>& points) {
  if (points.size() < kCirclesOfASpiral + 2) return false;
  bool grows = true, falls = true;
  double before = curvature_through(points[0], points[1], points[2]);
  for (std::size_t i = 2; i + 1 < points.size(); ++i) {
    const double here = curvature_through(points[i - 1], points[i], points[i + 1]);
    grows = grows && here > before;
    falls = falls && here < before;
    before = here;
  }
  return grows || falls;
}

}  // namespace

CoarsePolygon coarse_polygon(const std::vector<Vec2>& points, const std::vector<double>& tolerance,
                             bool closed, double angle) {
  CoarsePolygon out;
  const std::size_t n = points.size();
  if (n < 3 || (!closed && is_spiral(points))) return out;
  std::vector<double> turns;
  for (std::size_t i = closed ? 0 : 1; i < (closed ? n : n - 1); ++i) {
    const std::size_t before = (i + n - 1) % n, after = (i + 1) % n;
    const Vec2 in = points[i] - points[before], leave = points[after] - points[i];
    const double noise =
        tolerance.empty() ? 0.0 : std::max({tolerance[before], tolerance[i], tolerance[after]});
    const double turn = std::abs(turning(in, leave));
    if (turn <= kInLine || std::min(norm(in), norm(leave)) < kChordPerTolerance * noise) continue;
    turns.push_back(turn);
    if (turn >= angle) out.corners.push_back(i);
  }
  if (turns.empty()) return {};
  out.turn = median_within(turns);
  return out.turn >= kCoarseTurn ? out : CoarsePolygon{};
}

}  // namespace obvid
