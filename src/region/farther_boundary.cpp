// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/farther_boundary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::TwoArcs;

/// Equal steps of a piece between which the distance is taken to have one peak at the most. A lone
/// piece takes more of them than one among many.
constexpr std::size_t kStepsAlone = 6;
constexpr std::size_t kStepsAmongMany = 4;
/// Peaks of the samples this near to the largest are looked at closely.
constexpr double kCouldBeMore = 0.8;
/// Steps into which the neighbourhood of such a peak is cut first: the nearer arc of a boundary may
/// change there, which bends the distance.
constexpr std::size_t kFinerSteps = 24;
constexpr double kFinerCouldBeMore = 0.98;
/// Steps of a climb: parabolas converge faster than geometrically.
constexpr int kMostSteps = 16;
/// Places this close, of the three samples that a climb begins with, enclose the top: what can lie
/// between them is some 1e-5 of it.
constexpr double kClose = 2e-3;
/// Added for what may lie between two places where the nearer arc changes, of the distance.
constexpr double kUpward = 3e-4;
/// Roundings of a point seen from the start of its chord, each 2^-53 of the coordinates' size.
constexpr double kPointRoundings = 8.0 * 0x1p-53;

/// A piece in the frame of the chord, quick to evaluate.
class LocalPiece {
 public:
  LocalPiece(const Piece& piece, Vec2 start, Vec2 along)
      : piece_(&piece), start_(start), along_(along) {
    const auto* bezier = std::get_if<RationalBezier>(&piece);
    if (bezier == nullptr) return;
    degree_ = bezier->degree;
    const Vec2 origin = bezier->origin - start;
    for (std::size_t j = 0; j <= static_cast<std::size_t>(degree_); ++j) {
      const Vec2 p = in_frame(origin + bezier->offset[j]);
      weight_[j] = bezier->weight[j];
      weighted_[j] = weight_[j] * p;
    }
  }

  [[nodiscard]] Vec2 at(double t) const {
    if (degree_ == 0) return in_frame(evaluate(*piece_, t).point - start_);
    std::array<Vec2, kMaxBezierDegree + 1> p = weighted_;
    std::array<double, kMaxBezierDegree + 1> w = weight_;
    const double s = 1.0 - t;
    for (auto left = static_cast<std::size_t>(degree_); left > 0; --left) {
      for (std::size_t j = 0; j < left; ++j) {
        p[j] = s * p[j] + t * p[j + 1];
        w[j] = s * w[j] + t * w[j + 1];
      }
    }
    return p[0] / w[0];
  }

 private:
  [[nodiscard]] Vec2 in_frame(Vec2 v) const { return {dot(along_, v), cross(along_, v)}; }

  const Piece* piece_;
  Vec2 start_, along_;
  int degree_ = 0;  // 0: no Bezier piece
  std::array<Vec2, kMaxBezierDegree + 1> weighted_;
  std::array<double, kMaxBezierDegree + 1> weight_;
};

/// The distance from the farther boundary along a path; its parameter counts pieces.
class AlongPath {
 public:
  AlongPath(const PieceSpan& path, const PlacedRegion& placed)
      : path_(path),
        placed_(placed),
        from_start_(placed.frame, placed.region.from_start),
        to_end_(placed.frame, placed.region.to_end),
        local_(path.pieces.front(), placed.start, placed.along),
        wide_(dot(placed.frame.start_tangent, placed.frame.end_tangent) <= 0.0) {}

  [[nodiscard]] double first() const { return path_.t0; }
  [[nodiscard]] double last() const {
    return static_cast<double>(path_.pieces.size() - 1) + path_.t1;
  }
  double operator()(double u) {
    const std::size_t k = piece_at(u);
    if (k != at_) {
      local_ = LocalPiece(path_.pieces[k], placed_.start, placed_.along);
      at_ = k;
    }
    const Vec2 p = local_.at(u - static_cast<double>(k));
    // over a right angle the common normal does not tell which arc is near
    return wide_ ? std::max(from_start_.distance(p), to_end_.distance(p))
                 : std::max(from_start_.distance_from_near(p), to_end_.distance_from_near(p));
  }
  [[nodiscard]] Vec2 point(double u) const {
    const std::size_t k = piece_at(u);
    return evaluate(path_.pieces[k], u - static_cast<double>(k)).point;
  }

 private:
  [[nodiscard]] std::size_t piece_at(double u) const {
    return std::min(static_cast<std::size_t>(u), path_.pieces.size() - 1);
  }

  const PieceSpan& path_;
  const PlacedRegion& placed_;
  TwoArcs from_start_, to_end_;
  LocalPiece local_;
  bool wide_;
  std::size_t at_ = 0;
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

/// What a function that bends down can reach between three samples whose middle one is the largest:
/// it stays below the lines through two of them, beyond these.
double ceiling_of(const PathSample& a, const PathSample& b, const PathSample& c) {
  const double rise = (b.value - a.value) / (b.u - a.u), fall = (b.value - c.value) / (c.u - b.u);
  return b.value + std::max(rise * (c.u - b.u), fall * (b.u - a.u));
}

/// Climbs from three samples whose middle one is the largest: parabolas, then places close to the
/// top on both sides of it. The value is raised to what can lie between them.
PathSample climb(AlongPath& distance, PathSample a, PathSample b, PathSample c) {
  const double close = kClose * (c.u - a.u);
  for (int i = 0; i < kMostSteps && c.u - a.u > 2.0 * close; ++i) {
    double u = top_of(a, b, c);
    if (std::abs(u - b.u) < close) {
      // the farther neighbour comes close; a parabola would lead back to a known place
      u = c.u - b.u > b.u - a.u ? std::min(b.u + close, c.u) : std::max(b.u - close, a.u);
      if (u == a.u || u == c.u) break;
    }
    const PathSample next = {u, distance(u)};
    if (next.value > b.value) {
      (next.u > b.u ? a : c) = b;
      b = next;
    } else {
      (next.u > b.u ? c : a) = next;
    }
  }
  return {b.u, ceiling_of(a, b, c)};
}

/// Climbs from the largest of finer samples strictly between `a` and `c`.
PathSample climb_within(AlongPath& distance, const PathSample& a, const PathSample& c) {
  std::array<PathSample, kFinerSteps + 1> fine;
  double most = 0.0;
  for (std::size_t i = 0; i <= kFinerSteps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(kFinerSteps);
    const double u = a.u + part * (c.u - a.u);
    fine[i] = i == 0 ? a : i == kFinerSteps ? c : PathSample{u, distance(u)};
    most = std::max(most, fine[i].value);
  }
  PathSample best = a.value > c.value ? a : c;
  for (std::size_t i = 1; i < kFinerSteps; ++i) {
    const double here = fine[i].value;
    if (here < kFinerCouldBeMore * most) continue;
    if (here < fine[i - 1].value || here < fine[i + 1].value) continue;
    const PathSample top = climb(distance, fine[i - 1], fine[i], fine[i + 1]);
    if (top.value > best.value) best = top;
  }
  return best;
}

/// Equal steps along the path, in order; looks at three neighbours at a time.
PathSample highest(AlongPath& distance, std::size_t steps, std::vector<PathSample>& samples) {
  PathSample best{distance.first(), 0.0};
  samples.resize(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(steps);
    const double u = distance.first() + part * (distance.last() - distance.first());
    samples[i] = {u, i == 0 || i == steps ? 0.0 : distance(u)};  // ends lie on both boundaries
    if (samples[i].value > best.value) best = samples[i];
  }
  const double close = kCouldBeMore * best.value;
  for (std::size_t i = 1; i < steps; ++i) {
    const PathSample &a = samples[i - 1], &b = samples[i], &c = samples[i + 1];
    if (!(b.value > close && b.value >= a.value && b.value >= c.value)) continue;
    const PathSample top = climb_within(distance, a, c);
    if (top.value > best.value) best = top;
  }
  return best;
}

}  // namespace

FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed) {
  AlongPath distance(path, placed);
  const std::size_t count = path.pieces.size();
  std::vector<PathSample> samples;
  const PathSample best =
      highest(distance, count == 1 ? kStepsAlone : kStepsAmongMany * count, samples);
  const Vec2 at = distance.point(best.u);
  const double rounding = kPointRoundings * (std::abs(at.x) + std::abs(at.y) + placed.frame.h);
  return {best.value * (1.0 + kUpward) + rounding, at};
}

}  // namespace obvid
