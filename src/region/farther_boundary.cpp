// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/farther_boundary.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "obvid/core/internal/always_inline.h"
#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::Arc;
using region_detail::TwoArcs;

/// Binary digits of the way to which the place of the farthest point is sought: the distance is
/// flat there, and told to the nine digits to which files are compared.
constexpr int kDigits = 18;
/// Where the distance has a corner at its top it is not flat.
constexpr int kDigitsOfCorner = 26;
/// A step of Newton's on one smooth piece that is so small leaves its square: nine digits too.
constexpr int kDigitsOfStep = 18;
constexpr std::uintmax_t kMostLooks = 60;
/// Part of the way to the end after which the distance is looked at again.
constexpr double kAside = 0.25;
/// Added for what lies between the place found and the farthest one, of the distance.
constexpr double kUpward = 1e-5;
/// Roundings of a point seen from the start of its chord, each 2^-53 of the coordinates' size.
constexpr double kPointRoundings = 16.0 * 0x1p-53;

struct Place {
  Vec2 point, by_parameter;
};

/// A piece in the frame of the chord, quick to evaluate.
class LocalPiece {
 public:
  LocalPiece(const Piece& piece, Vec2 start, Vec2 along)
      : piece_(&piece), start_(start), along_(along) {
    const auto* bezier = std::get_if<RationalBezier>(&piece);
    if (bezier == nullptr) return;
    degree_ = bezier->degree;
    const Vec2 origin = bezier->origin - start;
    double binomial = 1.0;
    for (int j = 0; j <= degree_; ++j) {
      const auto k = static_cast<std::size_t>(j);
      weight_[k] = binomial * bezier->weight[k];
      weighted_[k] = weight_[k] * in_frame(origin + bezier->offset[k]);
      binomial = binomial * (degree_ - j) / (j + 1);
    }
  }

  [[nodiscard]] Vec2 at(double t) const {
    if (degree_ == 0) return in_frame(evaluate(*piece_, t).point - start_);
    return degree_ == kOfSpirals ? sum(t, kOfSpirals) : sum(t, static_cast<std::size_t>(degree_));
  }

  [[nodiscard]] Place place(double t) const {
    if (degree_ == 0) {
      const Jet jet = evaluate(*piece_, t);
      return {in_frame(jet.point - start_), in_frame(jet.d1)};
    }
    return degree_ == kOfSpirals ? sums(t, kOfSpirals) : sums(t, static_cast<std::size_t>(degree_));
  }

 private:
  static constexpr int kOfSpirals = 4;  // known when compiled

  [[nodiscard]] OBVID_ALWAYS_INLINE Place sums(double t, std::size_t degree) const {
    const double s = 1.0 - t;
    double power = 1.0, w = weight_[0], w_by_t = 0.0;
    Vec2 p = weighted_[0], p_by_t{};
    for (std::size_t j = 1; j <= degree; ++j) {
      const double power_by_t = static_cast<double>(j) * power;
      power *= t;
      p_by_t = s * p_by_t - p + power_by_t * weighted_[j];
      w_by_t = s * w_by_t - w + power_by_t * weight_[j];
      p = s * p + power * weighted_[j];
      w = s * w + power * weight_[j];
    }
    const Vec2 point = p / w;
    return {point, (p_by_t - w_by_t * point) / w};
  }
  /// Bernstein's sum: no term is larger than the coordinates, as in de Casteljau's algorithm.
  [[nodiscard]] OBVID_ALWAYS_INLINE Vec2 sum(double t, std::size_t degree) const {
    const double s = 1.0 - t;
    double power = 1.0, w = weight_[0];
    Vec2 p = weighted_[0];
    for (std::size_t j = 1; j <= degree; ++j) {
      power *= t;
      p = s * p + power * weighted_[j];
      w = s * w + power * weight_[j];
    }
    return p / w;
  }
  [[nodiscard]] Vec2 in_frame(Vec2 v) const { return {dot(along_, v), cross(along_, v)}; }

  const Piece* piece_;
  Vec2 start_, along_;
  int degree_ = 0;                                   // 0: no Bezier piece
  std::array<Vec2, kMaxBezierDegree + 1> weighted_;  // times the weight and the binomial
  std::array<double, kMaxBezierDegree + 1> weight_;  // times the binomial
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
    const std::size_t k = go_to_piece_at(u);
    return local_.at(u - static_cast<double>(k));
  }
  [[nodiscard]] Place place(double u) {
    const std::size_t k = go_to_piece_at(u);
    return local_.place(u - static_cast<double>(k));
  }
  [[nodiscard]] bool is_one_piece() const { return path_.pieces.size() == 1; }
  [[nodiscard]] Vec2 in_plane(double u) const {
    const std::size_t k = piece_at(u);
    return evaluate(path_.pieces[k], u - static_cast<double>(k)).point;
  }

 private:
  [[nodiscard]] std::size_t piece_at(double u) const {
    return std::min(static_cast<std::size_t>(u), path_.pieces.size() - 1);
  }
  std::size_t go_to_piece_at(double u) {
    const std::size_t k = piece_at(u);
    if (k != at_) {
      local_ = LocalPiece(path_.pieces[k], placed_.start, placed_.along);
      at_ = k;
    }
    return k;
  }

  const PieceSpan& path_;
  const PlacedRegion& placed_;
  LocalPiece local_;
  std::size_t at_ = 0;
};

/// Where a path begins and ends, seen from the chord.
struct Ends {
  Vec2 first, last;
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
double crossing(LocalPath& path, const Ends& ends, const TwoArcs& arcs) {
  const Vec2 joint = arcs.second.start, along = arcs.second.start_tangent;
  const double a = path.first(), b = path.last();
  const double at_a = dot(ends.first - joint, along), at_b = dot(ends.last - joint, along);
  if (!(at_a < 0.0)) return a;
  if (!(at_b > 0.0)) return b;
  const auto with_slope = [&](double u) {
    const Place place = path.place(u);
    return std::pair(dot(place.point - joint, along), dot(place.by_parameter, along));
  };
  std::uintmax_t looks = kMostLooks;
  const double chord = a + (b - a) * (at_a / (at_a - at_b));
  return boost::math::tools::newton_raphson_iterate(
      with_slope, chord, a, b, path.is_one_piece() ? kDigitsOfStep : kDigitsOfCorner, looks);
}

/// Largest distance of the path from one boundary. One of the arcs, `osculating`, has the path's
/// own curvature at its end, the other one only its tangent. A circle meets a curve of monotone
/// curvature three times at the most, counted with multiplicity: so the distance from the
/// osculating circle grows all the way to the common normal, and that from the other circle has one
/// top at the most from there to the end of the path.
Farthest from_boundary(LocalPath& path, const Ends& ends, const TwoArcs& arcs, bool first_osculates,
                       bool wide) {
  const double a = path.first(), b = path.last();
  if (wide) {  // over a right angle the normal does not tell which arc is near
    return top_between([&](double u) { return arcs.distance(path.at(u)); }, a, b, kDigitsOfCorner);
  }
  const Arc& other = first_osculates ? arcs.second : arcs.first;
  const double joint = crossing(path, ends, arcs), end = first_osculates ? b : a;
  const auto [there, on] = path.place(joint);
  const Vec2 ahead = first_osculates ? on : -on;
  const Farthest corner{joint, other.circle_distance(there)};
  const bool grows =
      other.growth(there, ahead) > 0.0 ||  // rounding decides where it is 0
      other.circle_distance(path.at(joint + kAside * (end - joint))) > corner.distance;
  if (!grows) return corner;
  const double way = end - joint;
  const Farthest top =
      top_between([&](double part) { return other.circle_distance(path.at(joint + part * way)); },
                  0.0, 1.0, kDigits);
  return top.distance > corner.distance ? Farthest{joint + top.u * way, top.distance} : corner;
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
  const Ends ends{local.at(local.first()), local.at(local.last())};
  const TwoArcs from_start(frame, placed.region.from_start), to_end(frame, placed.region.to_end);
  const Farthest one = from_boundary(local, ends, from_start, true, wide);
  const Farthest two = from_boundary(local, ends, to_end, false, wide);
  const Farthest& best = one.distance > two.distance ? one : two;
  const Vec2 at = local.in_plane(best.u);
  const double rounding = kPointRoundings * (std::abs(at.x) + std::abs(at.y) + frame.h);
  return {best.distance * (1.0 + kUpward) + rounding, at};
}

}  // namespace obvid
