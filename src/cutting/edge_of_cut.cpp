// SPDX-License-Identifier: Apache-2.0
#include "obvid/cutting/internal/edge_of_cut.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "edges.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/angle.h"
#include "offset_path.h"

namespace obvid {
namespace {

using namespace cutting;

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;  // rad
constexpr double kApart = 0.1;                           // of the radius: places that are looked at
constexpr double kMostPlacesOfOne = 4096;
constexpr double kInside = 1e-4;  // of the radius: nearer to the way the tool takes it
constexpr int kHalvings = 16;
constexpr int kMostChordsOfOne = 4096;

class EdgeOfCut {
 public:
  EdgeOfCut(double radius, double within) : radius_(radius), within_(within) {}

  std::vector<Piece> run(const std::vector<CutMove>& moves) {
    for (const CutMove& move : moves) {
      if (move.kind == CutMoveKind::kCut) add_way(move.piece);
    }
    ArcPath all;
    all.pieces = ways_;
    way_.add(all, 0);
    way_.finish();
    for (std::size_t k = 0; k < ways_.size();) {
      std::size_t end = k + 1;
      while (end < ways_.size() && start_point(ways_[end]) == end_point(ways_[end - 1])) ++end;
      add_chain(k, end);
      k = end;
    }
    return std::move(out_);
  }

 private:
  void add_way(const Piece& piece) {
    if (!std::holds_alternative<RationalBezier>(piece)) {
      ways_.push_back(piece);
      return;
    }
    const int chords = chord_steps(piece, within_, 1, kMostChordsOfOne);
    Vec2 from = start_point(piece);
    for (int k = 1; k <= chords; ++k) {
      const Vec2 to =
          k == chords ? end_point(piece) : evaluate(piece, static_cast<double>(k) / chords).point;
      if (from != to) ways_.emplace_back(LinePiece{from, to});
      from = to;
    }
  }

  void add_chain(std::size_t first, std::size_t end) {
    const bool closed = start_point(ways_[first]) == end_point(ways_[end - 1]);
    for (std::size_t k = first; k < end; ++k) {
      for (const double side : {radius_, -radius_}) {
        if (const auto parallel = parallel_piece(ways_[k], side)) keep_outside(*parallel);
      }
      const bool last = k + 1 == end;
      if (!last || closed) around_corner(ways_[k], ways_[last ? first : k + 1]);
    }
    if (closed) return;
    const double in = heading_at_start(ways_[first]), out = heading_at_end(ways_[end - 1]);
    around(start_point(ways_[first]), in + kQuarterTurn, 2.0 * kQuarterTurn);
    around(end_point(ways_[end - 1]), out - kQuarterTurn, 2.0 * kQuarterTurn);
  }

  /// On the side that a corner turns away from.
  void around_corner(const Piece& before, const Piece& behind) {
    const double from = heading_at_end(before), to = heading_at_start(behind);
    const double turn = turn_between(from, to);
    if (std::abs(turn) * radius_ <= within_ * kInside) return;
    around(end_point(before), from + (turn > 0.0 ? -kQuarterTurn : kQuarterTurn), turn);
  }

  /// An arc of the tool's radius from the direction `from` of its centre, by `turn`.
  void around(Vec2 centre, double from, double turn) {
    const double side = turn > 0.0 ? 1.0 : -1.0;
    keep_outside(ArcPiece{centre + radius_ * unit_at(from), centre + radius_ * unit_at(from + turn),
                          from + side * kQuarterTurn, side / radius_, std::abs(turn) * radius_});
  }

  [[nodiscard]] bool is_outside(const Piece& piece, double t) const {
    return way_.nearest(evaluate(piece, t).point).distance >= radius_ * (1.0 - kInside);
  }

  /// Between a place that is outside and one that is not.
  [[nodiscard]] double border(const Piece& piece, double outside, double inside) const {
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (outside + inside);
      (is_outside(piece, middle) ? outside : inside) = middle;
    }
    return outside;
  }

  void keep_outside(const Piece& piece) {
    const double length = length_of(piece);
    if (!(length > 0.0)) return;
    const auto parts =
        static_cast<int>(std::clamp(std::ceil(length / (kApart * radius_)), 2.0, kMostPlacesOfOne));
    double begin = 0.0;
    bool before = false;
    for (int k = 0; k <= parts; ++k) {
      const double t = static_cast<double>(k) / parts, last = static_cast<double>(k - 1) / parts;
      const bool now = is_outside(piece, t);
      if (now && !before) begin = k == 0 ? 0.0 : border(piece, t, last);
      if (!now && before) add(piece, begin, border(piece, last, t));
      before = now;
    }
    if (before) add(piece, begin, 1.0);
  }

  void add(const Piece& piece, double from, double to) {
    if (to > from) out_.push_back(part_of(piece, from, to));
  }

  double radius_, within_;
  std::vector<Piece> ways_, out_;
  Edges way_;
};

}  // namespace

std::vector<Piece> edge_of_cut(const std::vector<CutMove>& moves, double radius, double within) {
  if (!(radius > 0.0)) return {};
  return EdgeOfCut(radius, within).run(moves);
}

}  // namespace obvid
