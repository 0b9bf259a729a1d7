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

/// Equal steps of a piece to begin with. A lone piece takes more of them than one among many.
constexpr std::size_t kStepsAlone = 6;
constexpr std::size_t kStepsAmongMany = 3;
/// What the bound may exceed the largest distance found, as its part.
constexpr double kUpward = 3e-4;
/// What the distance from an arc may bend more between two places of a step than these and the
/// middle tell. Steps that matter are halved until it bends evenly.
constexpr double kBendBetween = 2.0;
constexpr int kMostHalvings = 12;
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

/// Distances of one point from the four arcs of both boundaries.
struct FromArcs {
  std::array<double, 4> arc{};

  /// From the farther boundary.
  [[nodiscard]] double farther() const {
    return std::max(std::min(arc[0], arc[1]), std::min(arc[2], arc[3]));
  }
};

/// Distances along a path; its parameter counts pieces.
class AlongPath {
 public:
  AlongPath(const PieceSpan& path, const PlacedRegion& placed)
      : path_(path),
        placed_(placed),
        from_start_(placed.frame, placed.region.from_start),
        to_end_(placed.frame, placed.region.to_end),
        local_(path.pieces.front(), placed.start, placed.along) {}

  [[nodiscard]] double first() const { return path_.t0; }
  [[nodiscard]] double last() const {
    return static_cast<double>(path_.pieces.size() - 1) + path_.t1;
  }
  /// `k`: the piece, which `u` alone does not tell at a joint.
  FromArcs operator()(std::size_t k, double u) {
    if (k != at_) {
      local_ = LocalPiece(path_.pieces[k], placed_.start, placed_.along);
      at_ = k;
    }
    const Vec2 p = local_.at(u - static_cast<double>(k));
    return {{from_start_.first.distance(p), from_start_.second.distance(p),
             to_end_.first.distance(p), to_end_.second.distance(p)}};
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
  std::size_t at_ = 0;
};

/// Part of one piece between two places.
struct Step {
  std::size_t piece = 0;
  double from = 0.0, to = 0.0;
  FromArcs at_from, at_to;
};

/// Upper bound of the distance from the farther boundary on a step. The distance from one arc of a
/// boundary is never less than that from the boundary; between three places it is at most the
/// largest of them and an eighth of its second derivative, which their second difference tells.
double ceiling_of(const FromArcs& a, const FromArcs& middle, const FromArcs& b) {
  FromArcs top;
  for (std::size_t i = 0; i < top.arc.size(); ++i) {
    const double bend = std::abs(a.arc[i] - 2.0 * middle.arc[i] + b.arc[i]);
    top.arc[i] = std::max({a.arc[i], middle.arc[i], b.arc[i]}) + 0.125 * kBendBetween * bend;
  }
  return top.farther();
}

/// The largest distance along a path, by halving the steps whose ceiling is above what was found.
class Highest {
 public:
  Highest(AlongPath& distance, double rounding) : distance_(distance), rounding_(rounding) {}

  void run(std::size_t pieces, double t0, double t1) {
    const std::size_t steps = pieces == 1 ? kStepsAlone : kStepsAmongMany;
    std::vector<Step> all;
    all.reserve(pieces * steps);
    for (std::size_t k = 0; k < pieces; ++k) {
      const double from = k == 0 ? t0 : 0.0, to = k + 1 == pieces ? t1 : 1.0;
      FromArcs before = look(k, static_cast<double>(k) + from);
      double last = static_cast<double>(k) + from;
      for (std::size_t i = 1; i <= steps; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(steps);
        const double u = static_cast<double>(k) + from + part * (to - from);
        const FromArcs here = look(k, u);
        all.push_back({k, last, u, before, here});
        before = here;
        last = u;
      }
    }
    for (const Step& step : all) bound_step(step, 0);
  }

  double found = 0.0, bound = 0.0, at = 0.0;

 private:
  FromArcs look(std::size_t piece, double u) {
    const FromArcs here = distance_(piece, u);
    const double away = here.farther();
    if (away > found) {
      found = away;
      at = u;
    }
    return here;
  }

  void bound_step(const Step& step, int halvings) {
    const double u = 0.5 * (step.from + step.to);
    const FromArcs middle = look(step.piece, u);
    const double ceiling = ceiling_of(step.at_from, middle, step.at_to);
    if (ceiling <= std::max((1.0 + kUpward) * found, found + rounding_) ||
        halvings == kMostHalvings) {
      bound = std::max(bound, ceiling);
      return;
    }
    bound_step({step.piece, step.from, u, step.at_from, middle}, halvings + 1);
    bound_step({step.piece, u, step.to, middle, step.at_to}, halvings + 1);
  }

  AlongPath& distance_;
  double rounding_;
};

}  // namespace

FartherBoundary farther_boundary(const PieceSpan& path, const PlacedRegion& placed) {
  AlongPath distance(path, placed);
  const Vec2 middle = distance.point(0.5 * (distance.first() + distance.last()));
  const double rounding =
      kPointRoundings * (std::abs(middle.x) + std::abs(middle.y) + placed.frame.h);
  Highest highest(distance, rounding);
  highest.run(path.pieces.size(), path.t0, path.t1);
  return {highest.bound + rounding, distance.point(highest.at)};
}

}  // namespace obvid
