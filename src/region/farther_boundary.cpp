// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/farther_boundary.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::Arc;
using region_detail::TwoArcs;

/// Binary digits to which the place of the farthest point is sought: the distance is flat there.
constexpr int kDigits = 18;
/// Where the distance has a corner at its top it is not flat.
constexpr int kDigitsOfCorner = 26;
constexpr std::uintmax_t kMostLooks = 60;
/// Part of the way to the end after which the distance is looked at again.
constexpr double kAside = 0.25;
/// Added for what lies between the place found and the farthest one, of the distance.
constexpr double kUpward = 1e-5;
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
    constexpr std::size_t kOfSpirals = 4;  // known when compiled
    return degree_ == kOfSpirals ? cut<kOfSpirals>(t) : cut<0>(t);
  }

 private:
  /// De Casteljau's algorithm; degree 0: the piece's own.
  template <std::size_t kDegree>
  [[nodiscard]] Vec2 cut(double t) const {
    const std::size_t degree = kDegree > 0 ? kDegree : static_cast<std::size_t>(degree_);
    constexpr std::size_t kCount = (kDegree > 0 ? kDegree : kMaxBezierDegree) + 1;
    std::array<Vec2, kCount> p;
    std::array<double, kCount> w;
    std::copy_n(weighted_.begin(), degree + 1, p.begin());
    std::copy_n(weight_.begin(), degree + 1, w.begin());
    const double s = 1.0 - t;
    for (std::size_t left = degree; left > 0; --left) {
      for (std::size_t j = 0; j < left; ++j) {
        p[j] = s * p[j] + t * p[j + 1];
        w[j] = s * w[j] + t * w[j + 1];
      }
    }
    return p[0] / w[0];
  }
  [[nodiscard]] Vec2 in_frame(Vec2 v) const { return {dot(along_, v), cross(along_, v)}; }

  const Piece* piece_;
  Vec2 start_, along_;
  int degree_ = 0;  // 0: no Bezier piece
  std::array<Vec2, kMaxBezierDegree + 1> weighted_;
  std::array<double, kMaxBezierDegree + 1> weight_;
};

/// A path seen from the chord; its parameter counts pieces.
class LocalPath {
 public:
  LocalPath(const PieceSpan& path, const PlacedRegion& placed)
      : path_(path), placed_(placed), local_(path.pieces.front(), placed.start, placed.along) {}

  [[nodiscard]] double first() const { return path_.t0; }
  [[nodiscard]] double last() const {
    return static_cast<double>(path_.pieces.size() - 1) + path_.t1;
  }
  [[nodiscard]] Vec2 at(double u) {
    const std::size_t k = piece_at(u);
    if (k != at_) {
      local_ = LocalPiece(path_.pieces[k], placed_.start, placed_.along);
      at_ = k;
    }
    return local_.at(u - static_cast<double>(k));
  }
  /// Of the tangent, any length.
  [[nodiscard]] Vec2 direction(double u) const {
    const std::size_t k = piece_at(u);
    const Vec2 d = evaluate(path_.pieces[k], u - static_cast<double>(k)).d1;
    return {dot(placed_.along, d), cross(placed_.along, d)};
  }
  [[nodiscard]] Vec2 in_plane(double u) const {
    const std::size_t k = piece_at(u);
    return evaluate(path_.pieces[k], u - static_cast<double>(k)).point;
  }

 private:
  [[nodiscard]] std::size_t piece_at(double u) const {
    return std::min(static_cast<std::size_t>(u), path_.pieces.size() - 1);
  }

  const PieceSpan& path_;
  const PlacedRegion& placed_;
  LocalPiece local_;
  std::size_t at_ = 0;
};

struct Farthest {
  double u = 0.0;
  double distance = 0.0;
};

/// Largest value between `a` and `b` of a distance that rises to it and falls from it.
template <typename Distance>
Farthest top_between(const Distance& distance, double a, double b, int digits) {
  std::uintmax_t looks = kMostLooks;
  const auto [u, negative] = boost::math::tools::brent_find_minima(
      [&](double x) { return -distance(x); }, a, b, digits, looks);
  return {u, -negative};
}

/// Where the path crosses the common normal of both arcs. Its tangents keep within a right angle of
/// theirs: it crosses once.
double crossing(LocalPath& path, const TwoArcs& arcs) {
  const auto beyond = [&](double u) {
    return dot(path.at(u) - arcs.second.start, arcs.second.start_tangent);
  };
  const double a = path.first(), b = path.last();
  const double at_a = beyond(a), at_b = beyond(b);
  if (!(at_a < 0.0)) return a;
  if (!(at_b > 0.0)) return b;
  std::uintmax_t looks = kMostLooks;
  const auto [low, high] = boost::math::tools::toms748_solve(
      beyond, a, b, at_a, at_b, boost::math::tools::eps_tolerance<double>(kDigitsOfCorner), looks);
  return 0.5 * (low + high);
}

/// Largest distance of the path from one boundary. One of the arcs, `osculating`, has the path's
/// own curvature at its end, the other one only its tangent. A circle meets a curve of monotone
/// curvature three times at the most, counted with multiplicity: so the distance from the
/// osculating circle grows all the way to the common normal, and that from the other circle has one
/// top at the most from there to the end of the path.
Farthest from_boundary(LocalPath& path, const TwoArcs& arcs, bool first_osculates, bool wide) {
  const double a = path.first(), b = path.last();
  if (wide) {  // over a right angle the normal does not tell which arc is near
    return top_between([&](double u) { return arcs.distance(path.at(u)); }, a, b, kDigitsOfCorner);
  }
  const Arc& other = first_osculates ? arcs.second : arcs.first;
  const double joint = crossing(path, arcs), end = first_osculates ? b : a;
  const Vec2 there = path.at(joint);
  const Vec2 ahead = first_osculates ? path.direction(joint) : -path.direction(joint);
  const Farthest corner{joint, other.circle_distance(there)};
  const bool grows =
      other.growth(there, ahead) > 0.0 ||  // rounding decides where it is 0
      other.circle_distance(path.at(joint + kAside * (end - joint))) > corner.distance;
  if (!grows) return corner;
  const Farthest top =
      top_between([&](double way) { return other.circle_distance(path.at(joint + way)); },
                  std::min(end - joint, 0.0), std::max(end - joint, 0.0), kDigits);
  return top.distance > corner.distance ? Farthest{joint + top.u, top.distance} : corner;
}

bool spans_right_angle(const std::array<Vec2, 4>& directions) {
  for (const Vec2 a : directions) {
    for (const Vec2 b : directions) {
      if (dot(a, b) <= 0.0) return true;
    }
  }
  return false;
}

}  // namespace

FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed) {
  LocalPath local(path, placed);
  const ChordFrame& frame = placed.frame;
  const bool wide = spans_right_angle({frame.start_tangent, frame.end_tangent,
                                       placed.region.from_start.joint_tangent,
                                       placed.region.to_end.joint_tangent});
  const Farthest one = from_boundary(local, TwoArcs(frame, placed.region.from_start), true, wide);
  const Farthest two = from_boundary(local, TwoArcs(frame, placed.region.to_end), false, wide);
  const Farthest& best = one.distance > two.distance ? one : two;
  const Vec2 at = local.in_plane(best.u);
  const double rounding = kPointRoundings * (std::abs(at.x) + std::abs(at.y) + frame.h);
  return {best.distance * (1.0 + kUpward) + rounding, at};
}

}  // namespace obvid
