// SPDX-License-Identifier: Apache-2.0
#include "cut_splines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "obvid/curve/internal/contour_path.h"
#include "obvid/curve/internal/curvature_extent.h"
#include "obvid/curve/internal/path_distance.h"

namespace obvid::cutting {
namespace {

/// Most that a cubic turns, rad.
constexpr double kMostTurn = 0.5 * std::numbers::pi;
/// Of the fastest piece's feed: slower ones are not joined to it, as a block has one feed.
constexpr double kSlowest = 0.8;
/// Places of the path that a cubic is led along, and rounds of leading it.
constexpr int kPlaces = 16, kRounds = 8;
/// Blocks that a cubic takes the place of, at least.
constexpr std::size_t kFewest = 3;
/// Radii that differ by less, of the larger curvature, are one: parts of a circle.
constexpr double kSameCurvature = 1e-9;
/// Places of a cubic whose curvature says its feed.
constexpr int kCurvatures = 64;

/// Sums of squares of distances, by the lengths of both inner legs.
struct Normal {
  double aa = 0.0, ab = 0.0, bb = 0.0, ar = 0.0, br = 0.0;

  void add(double a, double b, double rest) {
    aa += a * a;
    ab += a * b;
    bb += b * b;
    ar += a * rest;
    br += b * rest;
  }
  /// Nothing for what is straight: all lengths of legs are the same to it.
  [[nodiscard]] std::optional<Vec2> solved() const {
    constexpr double kSingular = 1e-12;  // of the product of the diagonal
    const double determinant = aa * bb - ab * ab;
    if (!(determinant > kSingular * aa * bb)) return std::nullopt;
    return Vec2{(ar * bb - br * ab) / determinant, (br * aa - ar * ab) / determinant};
  }
};

/// A cubic along pieces: of all with their ends and headings the one whose places lie nearest to
/// those of the path, by squares of the distances across it (tangent distances: [Hoschek, Lasser
/// 1993]).
class CubicOf {
 public:
  explicit CubicOf(std::span<const Piece> path)
      : start_(start_point(path.front())),
        end_(end_point(path.back())),
        leaves_(unit_at(heading_at_start(path.front()))),
        arrives_(unit_at(heading_at_end(path.back()))) {
    const ContourPath along(path);
    length_ = along.length();
    for (int k = 1; k < kPlaces; ++k) {
      const double part = static_cast<double>(k) / kPlaces;
      const Jet jet = along.jet(part * length_, true);
      places_.push_back({jet.point, left_normal(jet.d1 / norm(jet.d1)), part});
    }
  }

  [[nodiscard]] std::optional<RationalBezier> run() {
    constexpr double kThird = 1.0 / 3.0;
    Vec2 legs{kThird * length_, kThird * length_};
    for (int round = 0; round < kRounds; ++round) {
      const RationalBezier now = with(legs);
      Normal sums;
      for (Place& place : places_) {
        const Jet jet = evaluate(now, place.t);
        const double along = dot(place.at - jet.point, jet.d1) / dot(jet.d1, jet.d1);
        place.t = std::clamp(place.t + along, 0.0, 1.0);
        const double t = place.t, s = 1.0 - t, first = 3.0 * s * s * t, second = 3.0 * s * t * t;
        const Vec2 fixed =
            (s * s * s + first) * (start_ - place.at) + (second + t * t * t) * (end_ - place.at);
        sums.add(first * dot(leaves_, place.across), -second * dot(arrives_, place.across),
                 -dot(fixed, place.across));
      }
      const auto better = sums.solved();
      if (!better) break;
      legs = *better;
      if (!(legs.x > 0.0 && legs.y > 0.0 && legs.x < length_ && legs.y < length_)) {
        return std::nullopt;
      }
    }
    return with(legs);
  }

 private:
  struct Place {
    Vec2 at, across;
    double t;
  };

  [[nodiscard]] RationalBezier with(Vec2 legs) const {
    RationalBezier out;
    out.degree = 3;
    out.offset = {start_, start_ + legs.x * leaves_, end_ - legs.y * arrives_, end_};
    out.weight = {1.0, 1.0, 1.0, 1.0};
    return out;
  }

  Vec2 start_, end_, leaves_, arrives_;
  double length_ = 0.0;
  std::vector<Place> places_;
};

class Joined {
 public:
  Joined(std::vector<CutBlock> blocks, const BlockRules& rules, const SplineRules& splines,
         Watch& watch)
      : blocks_(std::move(blocks)), rules_(rules), splines_(splines), watch_(watch) {}

  std::vector<CutBlock> run() {
    std::size_t i = 0;
    while (i < blocks_.size()) {
      if (watch_.cancelled()) break;
      const std::size_t end = smooth_row(i);
      if (end - i < kFewest) {
        take(i++);
        continue;
      }
      std::vector<Piece> row;
      for (std::size_t k = i; k < end; ++k) row.push_back(blocks_[k].piece);
      add_row(i, row);
      z_ = blocks_[end - 1].z;
      i = end;
    }
    for (; i < blocks_.size(); ++i) take(i);
    return std::move(out_);
  }

 private:
  void take(std::size_t i) {
    z_ = blocks_[i].z;
    out_.push_back(std::move(blocks_[i]));
  }

  /// Arcs of different radii with a common tangent.
  [[nodiscard]] static bool go_on(const Piece& before, const Piece& behind) {
    const double a = curvature_of(before), b = curvature_of(behind);
    const double most = std::max(std::abs(a), std::abs(b));
    return a != 0.0 && b != 0.0 && std::abs(a - b) > kSameCurvature * most &&
           is_smooth(before, behind);
  }

  /// The end of blocks that run on smoothly at the height where the tool is.
  [[nodiscard]] std::size_t smooth_row(std::size_t i) const {
    const auto level = [&](const CutBlock& one) {
      return one.kind == CutBlock::Kind::kCut && one.z == z_;
    };
    if (!level(blocks_[i])) return i + 1;
    std::size_t end = i + 1;
    double slowest = blocks_[i].feed, fastest = slowest;
    for (; end < blocks_.size() && level(blocks_[end]); ++end) {
      const CutBlock &before = blocks_[end - 1], &one = blocks_[end];
      slowest = std::min(slowest, one.feed);
      fastest = std::max(fastest, one.feed);
      if (one.track != before.track || one.first_pass != before.first_pass ||
          !go_on(before.piece, one.piece) || slowest < kSlowest * fastest) {
        break;
      }
    }
    return end;
  }

  /// From each joint as far as one cubic goes.
  void add_row(std::size_t first, std::span<const Piece> row) {
    for (std::size_t at = 0; at < row.size();) {
      std::size_t good = 1, step = 1;
      std::optional<RationalBezier> best;
      const auto reaches = [&](std::size_t count) {
        auto cubic = along(row.subspan(at, count));
        if (!cubic) return false;
        good = count;
        best = std::move(cubic);
        return true;
      };
      while (good + step <= row.size() - at && reaches(good + step)) step *= 2;
      for (step = std::min(step, row.size() - at - good); step > 0; step /= 2) {
        if (good + step <= row.size() - at) reaches(good + step);
      }
      if (good < kFewest) {
        best.reset();
        good = 1;
      }
      CutBlock block = blocks_[first + at];
      if (best) {
        for (std::size_t k = 1; k < good; ++k) {
          block.feed = std::min(block.feed, blocks_[first + at + k].feed);
        }
        block.feed = std::min(block.feed, feed_on(*best));
        block.piece = *best;
      }
      out_.push_back(std::move(block));
      at += good;
    }
  }

  [[nodiscard]] std::optional<RationalBezier> along(std::span<const Piece> path) const {
    if (watch_.was_cancelled()) return std::nullopt;
    double turn = 0.0;
    for (const Piece& piece : path) turn += std::abs(curvature_of(piece)) * length_of(piece);
    if (turn > kMostTurn) return std::nullopt;
    auto cubic = CubicOf(path).run();
    if (!cubic) return std::nullopt;
    const Piece one = *cubic;
    if (!(path_distance({&one, 1}, path) <= splines_.within)) return std::nullopt;
    return cubic;
  }

  /// Of the cubic as it will be printed.
  [[nodiscard]] double feed_on(RationalBezier cubic) const {
    for (Vec2& p : cubic.offset) {
      p = splines_.last_digit *
          Vec2{std::round(p.x / splines_.last_digit), std::round(p.y / splines_.last_digit)};
    }
    std::vector<double> at;
    for (int k = 0; k <= kCurvatures; ++k) at.push_back(static_cast<double>(k) / kCurvatures);
    const CurvatureExtent extent = curvature_extent(cubic, at);
    return feed_for(std::max(-extent.least, extent.largest), rules_);
  }

  std::vector<CutBlock> blocks_, out_;
  const BlockRules& rules_;
  const SplineRules& splines_;
  double z_ = 0.0;
  Watch& watch_;
};

}  // namespace

std::vector<CutBlock> with_splines(std::vector<CutBlock> blocks, const BlockRules& rules,
                                   const SplineRules& splines, Watch& watch) {
  return Joined(std::move(blocks), rules, splines, watch).run();
}

}  // namespace obvid::cutting
