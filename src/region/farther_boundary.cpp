// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/farther_boundary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::TwoArcs;

/// Equal steps of a piece between which the distance is taken to have one peak at the most. A lone
/// piece takes more of them than one among many.
constexpr int kStepsAlone = 6;
constexpr int kStepsAmongMany = 2;
/// Peaks of the samples this near to the largest are looked at closely.
constexpr double kCouldBeMore = 0.8;
/// Steps of successive parabolas: their error falls faster than geometrically.
constexpr int kMostParabolas = 8;
/// When two neighbouring steps agree this far, of the distance, the peak is found.
constexpr double kFound = 1e-10;
/// Added for what rounding and the flat top of the peak leave, of the distance.
constexpr double kUpward = 1e-9;
/// Roundings of a point seen from the start of its chord, each 2^-53 of the coordinates' size.
constexpr double kPointRoundings = 8.0 * 0x1p-53;

/// The distance from the farther boundary along a path; its parameter counts pieces.
class AlongPath {
 public:
  AlongPath(const PieceSpan& path, const PlacedRegion& placed)
      : path_(path),
        from_start_(placed.frame, placed.region.from_start),
        to_end_(placed.frame, placed.region.to_end),
        start_(placed.start),
        along_(placed.along) {}

  [[nodiscard]] double first() const { return path_.t0; }
  [[nodiscard]] double last() const {
    return static_cast<double>(path_.pieces.size() - 1) + path_.t1;
  }
  [[nodiscard]] double operator()(double u) const {
    const Vec2 v = point(u) - start_;
    const Vec2 p = {dot(along_, v), cross(along_, v)};
    return std::max(from_start_.distance(p), to_end_.distance(p));
  }
  [[nodiscard]] Vec2 point(double u) const {
    const auto k = std::min(static_cast<std::size_t>(u), path_.pieces.size() - 1);
    return evaluate(path_.pieces[k], u - static_cast<double>(k)).point;
  }

 private:
  const PieceSpan& path_;
  TwoArcs from_start_, to_end_;
  Vec2 start_, along_;
};

struct PathSample {
  double u = 0.0;
  double value = 0.0;
};

/// Abscissa of the top of the parabola through three samples, within them.
double top_of(const PathSample& a, const PathSample& b, const PathSample& c) {
  const double left = (b.u - a.u) * (b.value - c.value), right = (b.u - c.u) * (b.value - a.value);
  const double twice = 2.0 * (left - right);
  if (twice == 0.0) return b.u;
  const double u = b.u - ((b.u - a.u) * left - (b.u - c.u) * right) / twice;
  return std::isfinite(u) ? std::clamp(u, a.u, c.u) : b.u;
}

/// Climbs from three samples whose middle one is the largest. Where a parabola leads back to a
/// known place, the middle of the longer side is tried.
PathSample climb(const AlongPath& distance, PathSample a, PathSample b, PathSample c) {
  for (int i = 0; i < kMostParabolas; ++i) {
    double u = top_of(a, b, c);
    const double apart = 1e-3 * (c.u - a.u);  // closer places say nothing new
    if (std::abs(u - b.u) < apart) u = b.u + (c.u - b.u > b.u - a.u ? apart : -apart);
    const PathSample next = {u, distance(u)};
    const double gained = std::abs(next.value - b.value);
    if (next.value > b.value) {
      (next.u > b.u ? a : c) = b;
      b = next;
    } else {
      (next.u > b.u ? c : a) = next;
    }
    if (gained <= kFound * b.value) break;
  }
  return b;
}

}  // namespace

FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed) {
  const AlongPath distance(path, placed);
  const int per_piece = path.pieces.size() == 1 ? kStepsAlone : kStepsAmongMany;
  const auto steps = static_cast<std::size_t>(per_piece) * path.pieces.size();
  std::vector<PathSample> samples(steps + 1);
  PathSample best{distance.first(), 0.0};
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    const double u = distance.first() + part * (distance.last() - distance.first());
    samples[i] = {u, distance(u)};
    if (samples[i].value > best.value) best = samples[i];
  }
  const double close = kCouldBeMore * best.value;
  for (std::size_t i = 1; i < steps; ++i) {
    const PathSample &a = samples[i - 1], &b = samples[i], &c = samples[i + 1];
    if (!(b.value > close && b.value >= a.value && b.value >= c.value)) continue;
    const PathSample top = climb(distance, a, b, c);
    if (top.value > best.value) best = top;
  }
  const Vec2 at = distance.point(best.u);
  const double rounding = kPointRoundings * (std::abs(at.x) + std::abs(at.y) + placed.frame.h);
  return {best.value * (1.0 + kUpward) + rounding, at};
}

}  // namespace obvid
