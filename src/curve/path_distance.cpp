// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/path_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "obvid/curve/internal/nearest.h"
#include "obvid/curve/internal/nearest_along.h"

namespace obvid {
namespace {

constexpr int kSamples = 16;  // of a piece, to begin with
/// Spans and halves that are looked at: many more than smooth paths ask for, and an end to it.
constexpr std::size_t kSpareLooks = 1000, kLooksPerSpan = 64;
constexpr int kMostHalvings = 24;  // of the spans between them
constexpr double kMoreThanFound =
    1e-3;  // of the largest distance found: what a bound may exceed it
/// Roundings of a coordinate that the bound of a span may exceed what was found there.
constexpr double kSpanRounding = 16.0 * std::numeric_limits<double>::epsilon();
/// What the largest rate between places of a span may be more than at its ends and in its middle.
/// Spans that matter are halved until the rate hardly changes along them.
constexpr double kRateBetween = 2.0;

/// A place of one path and the place of the other that it is compared with.
struct Match {
  double t = 0.0;         ///< on the piece that is followed
  std::size_t piece = 0;  ///< of the other path
  double u = 0.0;         ///< on that piece
  double distance = 0.0;
};

/// Upper bound of the distances of one path from another. Between two matches t0 and t1 on one
/// pair of pieces every place is compared with the one that lies as far between u0 and u1: the
/// difference of the two has lengths d0 and d1 at the ends, and between them at most the larger one
/// and an eighth of the largest second derivative. That sinks with the square of the span, so spans
/// whose bound is above what was found are halved.
class DistanceBound {
 public:
  DistanceBound(std::span<const Piece> from, std::span<const Piece> to, Watch* watch)
      : from_(from), to_(to), watch_(watch) {}

  double run() {
    constexpr double kCouldBeMore = 0.9;  // nearer than this to the largest, neighbours are tried
    NearestAlong follower(to_);
    for (const Piece& piece : from_) {
      if (is_to_end(watch_)) return found_;
      Match before;
      for (int k = 0; k <= kSamples; ++k) {
        const double t = static_cast<double>(k) / kSamples;
        const auto place = follower.next(evaluate(piece, t).point, kCouldBeMore * found_);
        const Match here{t, place.piece, place.t, place.distance};
        found_ = std::max(found_, here.distance);
        if (k > 0) spans_.push_back({&piece, before, here});
        before = here;
      }
    }
    bound_ = found_;
    most_looks_ = kSpareLooks + kLooksPerSpan * (spans_.size() + to_.size());
    for (const Between& span : spans_) {
      if (is_to_end(watch_)) return found_;
      cut_at_joints(*span.piece, span.first, span.last);
    }
    return bound_;
  }

 private:
  struct Between {
    const Piece* piece;
    Match first, last;
  };

  /// Spans whose ends are compared with two pieces are cut where a joint of these is nearest: a
  /// place of the span may be compared with any other, the bound holds for each.
  void cut_at_joints(const Piece& piece, Match first, const Match& last) {
    const std::size_t pieces = to_.size();
    const bool on = goes_on(first.piece, last.piece);
    while (first.piece != last.piece) {
      const Vec2 joint = evaluate(to_[first.piece], on ? 1.0 : 0.0).point;
      Match cut;
      cut.piece = first.piece;
      cut.u = on ? 1.0 : 0.0;
      cut.distance = HUGE_VAL;
      for (const double from : {first.t, last.t}) {  // a sharp turn may lie between them
        const double t = std::clamp(nearest_parameter(piece, joint, from), first.t, last.t);
        const double away = norm(evaluate(piece, t).point - joint);
        if (away >= cut.distance) continue;
        cut.t = t;
        cut.distance = away;
      }
      const Vec2 here = evaluate(piece, cut.t).point;
      const double most = 0.5 * (first.distance + last.distance + way(piece, first, last));
      if (cut.distance > most) return leap(piece, first, last, 0);  // another way round
      bound(piece, first, cut, 0);
      first = cut;
      first.piece = (cut.piece + (on ? 1 : pieces - 1)) % pieces;
      first.u = on ? 0.0 : 1.0;
      // pieces may leave a gap between them
      first.distance = norm(here - evaluate(to_[first.piece], first.u).point);
    }
    bound(piece, first, last, 0);
  }

  /// Whether the nearer way from one piece of the other path to another goes on along it: of a
  /// closed path over its seam, too.
  [[nodiscard]] bool goes_on(std::size_t first, std::size_t last) const {
    const bool ahead = first < last;
    const std::size_t joints = ahead ? last - first : first - last;
    if (2 * joints <= to_.size()) return ahead;
    const double gap = norm(end_point(to_.back()) - start_point(to_.front()));
    return gap <= found_ ? !ahead : ahead;
  }

  /// The way along a piece, at least.
  static double way(const Piece& piece, const Match& first, const Match& last) {
    double speed = 0.0;
    for (const double part : {0.0, 0.5, 1.0}) {
      const double t = first.t + part * (last.t - first.t);
      speed = std::max(speed, norm(evaluate(piece, t).d1));
    }
    return kRateBetween * speed * (last.t - first.t);
  }

  /// Between matches that no joint of the other path joins (the seam of a closed one): a distance
  /// grows by the way at most.
  void leap(const Piece& piece, const Match& first, const Match& last, int halvings) {
    if (first.piece == last.piece) return bound(piece, first, last, halvings);
    ++looked_at_;
    const double most = 0.5 * (first.distance + last.distance + way(piece, first, last));
    const bool enough = looked_at_ > most_looks_;
    if (most <= (1.0 + kMoreThanFound) * found_ || enough || halvings == kMostHalvings) {
      bound_ = std::max(bound_, most);
      return;
    }
    const double t = 0.5 * (first.t + last.t);
    const Vec2 here = evaluate(piece, t).point;
    Match middle{t, first.piece, 0.0, HUGE_VAL};
    for (const Match& end : {first, last}) {
      const double u = nearest_parameter(to_[end.piece], here, end.u);
      const double away = norm(here - evaluate(to_[end.piece], u).point);
      if (away < middle.distance) middle = {t, end.piece, u, away};
    }
    leap(piece, first, middle, halvings + 1);
    leap(piece, middle, last, halvings + 1);
  }

  void bound(const Piece& piece, const Match& first, const Match& last, int halvings) {
    ++looked_at_;
    const Vec2 place = evaluate(piece, first.t).point;
    const double ends = std::max(first.distance, last.distance);
    const double more = between(piece, first, last);
    const double rounding = kSpanRounding * std::max(std::abs(place.x), std::abs(place.y));
    const bool known = ends + more <= (1.0 + kMoreThanFound) * found_ || more <= rounding;
    const bool enough = looked_at_ > most_looks_;
    if (known || enough || halvings == kMostHalvings) {
      bound_ = std::max(bound_, ends + more);
      return;
    }
    const Piece& other = to_[first.piece];
    Match middle;
    middle.t = 0.5 * (first.t + last.t);
    middle.piece = first.piece;
    const Vec2 here = evaluate(piece, middle.t).point;
    middle.u = nearest_parameter(other, here, 0.5 * (first.u + last.u));
    middle.distance = norm(here - evaluate(other, middle.u).point);
    // the nearest of all may be on another piece: what was found is never above a true distance
    if (middle.u > 0.0 && middle.u < 1.0) found_ = std::max(found_, middle.distance);
    bound(piece, first, middle, halvings + 1);
    bound(piece, middle, last, halvings + 1);
  }

  /// What the distance may be more between two places than at them: by what the difference of the
  /// compared places bends away from its chord across the other path. What it bends along that path
  /// counts by the turning of the path alone: the nearest place moves along with it.
  [[nodiscard]] double between(const Piece& piece, const Match& first, const Match& last) const {
    const double dt = last.t - first.t, du = last.u - first.u;
    double across = 0.0, along = 0.0, length = 0.0;
    Vec2 start_tangent, end_tangent;
    for (const double part : {0.0, 0.5, 1.0}) {
      const Jet mine = evaluate(piece, first.t + part * dt);
      const Jet others = evaluate(to_[first.piece], first.u + part * du);
      const double speed = norm(others.d1);
      const Vec2 rate = (dt * dt) * mine.d2 - (du * du) * others.d2;
      if (!(speed > 0.0)) {  // a place with no direction: whatever bends away counts
        across = std::max(across, norm(rate));
        continue;
      }
      const Vec2 tangent = others.d1 / speed;
      across = std::max(across, std::abs(cross(tangent, rate)));
      along = std::max(along, std::abs(dot(tangent, rate)));
      length = std::max(length, speed * std::abs(du));
      if (part == 0.0) start_tangent = tangent;
      end_tangent = tangent;
    }
    const double turn = std::abs(cross(start_tangent, end_tangent));
    const double slip = 0.125 * kRateBetween * along;
    const double most = 0.125 * kRateBetween * across + slip * kRateBetween * turn +
                        (length > 0.0 ? 0.5 * kRateBetween * turn / length * slip * slip : slip);
    // a distance grows by the way at most: what holds where the matches leap (a closed circle)
    const double apart = std::abs(first.distance - last.distance);
    return std::min(most, 0.5 * std::max(0.0, way(piece, first, last) - apart));
  }

  std::span<const Piece> from_, to_;
  Watch* watch_;
  std::vector<Between> spans_;
  double found_ = 0.0, bound_ = 0.0;
  std::size_t looked_at_ = 0, most_looks_ = 0;
};

}  // namespace

double path_distance(std::span<const Piece> a, std::span<const Piece> b, Watch* watch) {
  if (a.empty() || b.empty()) return 0.0;
  return std::max(DistanceBound(a, b, watch).run(), DistanceBound(b, a, watch).run());
}

}  // namespace obvid
