// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/path_distance.h"

#include <algorithm>
#include <cmath>

#include "obvid/curve/nearest.h"

namespace obvid {
namespace {

constexpr int kSamples = 16;  // of a piece
constexpr int kThirds = 6;    // of the search between samples: to a tenth of their spacing

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
    t = nearest_parameter(path_[piece], p, t);
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
