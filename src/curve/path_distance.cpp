// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/path_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obvid {
namespace {

constexpr int kSamples = 16;        // of a piece
constexpr int kNewtonSteps = 40;    // towards a nearest point
constexpr double kFootStep = 1e-7;  // of a piece: the step after it would be the square of it
constexpr int kThirds = 6;          // of the search between samples: to a tenth of their spacing

double nearest_parameter(const LinePiece& line, Vec2 p, double) {
  const Vec2 along = line.end - line.start;
  const double square = dot(along, along);
  return square > 0.0 ? std::clamp(dot(p - line.start, along) / square, 0.0, 1.0) : 0.0;
}

double nearest_parameter(const ArcPiece& arc, Vec2 p, double) {
  const Vec2 v = p - arc.start, tangent = unit_at(arc.theta0);
  const double along = dot(v, tangent), across = cross(tangent, v);
  const double whole = arc.kappa * arc.length;
  double turn = std::atan2(arc.kappa * along, 1.0 - arc.kappa * across);
  // of the turns that mean the same direction the one nearest to the middle of the arc
  turn = 0.5 * whole + std::remainder(turn - 0.5 * whole, 2.0 * std::numbers::pi);
  const double t = whole != 0.0 ? turn / whole : along / arc.length;
  return std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0;
}

/// Newton's method from `t` between places where the distance still falls and rises again.
template <class Curve>
double nearest_parameter(const Curve& piece, Vec2 p, double t) {
  double low = 0.0, high = 1.0;
  bool low_tried = false, high_tried = false;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Jet jet = evaluate(piece, t);
    const Vec2 away = jet.point - p;
    const double slope = dot(away, jet.d1);
    const double bend = dot(jet.d1, jet.d1) + dot(away, jet.d2);
    (slope < 0.0 ? low : high) = t;
    (slope < 0.0 ? low_tried : high_tried) = true;
    const double step = bend > 0.0 ? -slope / bend : HUGE_VAL;
    if (std::abs(step) < kFootStep) return std::clamp(t + step, 0.0, 1.0);
    double next = bend > 0.0 ? t + step : (slope < 0.0 ? high : low);
    if (next >= high) next = high_tried ? 0.5 * (low + high) : high;
    if (next <= low) next = low_tried ? 0.5 * (low + high) : low;
    if (next == t) break;
    t = next;
  }
  return t;
}

/// The nearest point of a path to points that move along it.
class Follower {
 public:
  explicit Follower(std::span<const Piece> path) : path_(path) {}

  /// Distance of `p`; neighbouring pieces are tried when it is larger than `known`.
  double distance(Vec2 p, double known) {
    double here = settle(at_, t_, p);
    while (t_ == 1.0 && at_ + 1 < path_.size() && step_to(at_ + 1, 0.0, p, here)) {
    }
    while (t_ == 0.0 && at_ > 0 && step_to(at_ - 1, 1.0, p, here)) {
    }
    if (here <= known) return here;
    while (at_ + 1 < path_.size() && improve(at_ + 1, 0.0, p, here)) {
    }
    while (at_ > 0 && improve(at_ - 1, 1.0, p, here)) {
    }
    return here;
  }

 private:
  double settle(std::size_t piece, double& t, Vec2 p) const {
    t = std::visit([&](const auto& q) { return nearest_parameter(q, p, t); }, path_[piece]);
    return norm(evaluate(path_[piece], t).point - p);
  }

  /// Goes on to a neighbour that is not farther.
  bool step_to(std::size_t piece, double t, Vec2 p, double& here) {
    const double there = settle(piece, t, p);
    if (there > here) return false;
    here = there;
    at_ = piece;
    t_ = t;
    return true;
  }

  bool improve(std::size_t piece, double t, Vec2 p, double& here) {
    const double before = here;
    return step_to(piece, t, p, here) && here < before;
  }

  std::span<const Piece> path_;
  std::size_t at_ = 0;
  double t_ = 0.0;
};

/// Largest distance between t0 and t1 of a piece, where a sample between them is the largest.
double refine(const Piece& piece, double t0, double t1, Follower follower, double known) {
  double best = known;
  const auto away = [&](double t) {
    const double d = follower.distance(evaluate(piece, t).point, known);
    best = std::max(best, d);
    return d;
  };
  for (int i = 0; i < kThirds; ++i) {
    const double a = t0 + (t1 - t0) / 3.0, b = t1 - (t1 - t0) / 3.0;
    const bool rises = away(a) < away(b);
    (rises ? t0 : t1) = rises ? a : b;
  }
  return best;
}

double largest_from(std::span<const Piece> from, std::span<const Piece> to) {
  constexpr double kCouldBeMore = 0.9;  // samples this near to the largest are looked at closely
  Follower follower(to);
  double most = 0.0;
  for (const Piece& piece : from) {
    double before = 0.0, here = 0.0;
    for (int k = 0; k <= kSamples; ++k) {
      const Follower start = follower;
      const double next = follower.distance(
          evaluate(piece, static_cast<double>(k) / kSamples).point, kCouldBeMore * most);
      if (k >= 2 && here >= before && here >= next && here > kCouldBeMore * most) {
        most = refine(piece, (k - 2.0) / kSamples, static_cast<double>(k) / kSamples, start,
                      std::max(most, here));
      }
      most = std::max(most, next);
      before = here;
      here = next;
    }
  }
  return most;
}

}  // namespace

double path_distance(std::span<const Piece> a, std::span<const Piece> b) {
  if (a.empty() || b.empty()) return 0.0;
  return std::max(largest_from(a, b), largest_from(b, a));
}

}  // namespace obvid
