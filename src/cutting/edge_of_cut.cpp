// SPDX-License-Identifier: Apache-2.0
#include "obvid/cutting/internal/edge_of_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "edges.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/circle.h"
#include "offset_path.h"

namespace obvid {
namespace {

using namespace cutting;

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;  // rad
constexpr double kApart = 0.1;                           // of the radius: places that are looked at
constexpr double kMostPlacesOfOne = 4096;
constexpr double kInside = 1e-4;  // of the radius: nearer to the way the tool takes it
constexpr int kHalvings = 16;
/// Of the tolerance of the drawing: shorter pieces are none; how far off one line or circle pieces
/// may be that are drawn as one.
constexpr double kSliver = 0.5, kOneCircle = 0.25;
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
    drop_slivers();
    meet();
    join();
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

  /// What is left of arcs that the tool's radius uses up, and of corners that printed digits make.
  void drop_slivers() {
    out_.erase(
        std::remove_if(out_.begin(), out_.end(),
                       [&](const Piece& piece) { return length_of(piece) < kSliver * within_; }),
        out_.end());
  }

  /// An end of a piece.
  struct End {
    std::size_t piece = 0;
    bool last = false;
    Vec2 at;
  };

  /// Ends that belong together: each is the nearest of the other, within the tolerance.
  void meet() {
    std::vector<End> ends;
    for (std::size_t i = 0; i < out_.size(); ++i) {
      ends.push_back({i, false, start_point(out_[i])});
      ends.push_back({i, true, end_point(out_[i])});
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at.x < b.at.x; });
    std::vector<std::size_t> nearest(ends.size(), ends.size());
    std::vector<double> distance(ends.size(), within_);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && ends[j].at.x - ends[i].at.x <= within_; ++j) {
        if (ends[i].last == ends[j].last) continue;  // all run as the tool does
        const double d = norm(ends[j].at - ends[i].at);
        for (const auto& [one, other] : {std::pair(i, j), std::pair(j, i)}) {
          if (d > distance[one] || (d == distance[one] && nearest[one] != ends.size())) continue;
          distance[one] = d;
          nearest[one] = other;
        }
      }
    }
    std::vector<Vec2> starts, stops;
    for (const Piece& piece : out_) {
      starts.push_back(start_point(piece));
      stops.push_back(end_point(piece));
    }
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const std::size_t j = nearest[i];
      if (!ends[i].last || j == ends.size() || nearest[j] != i) continue;
      const Vec2 place = meeting_place(out_[ends[i].piece], out_[ends[j].piece]);
      stops[ends[i].piece] = starts[ends[j].piece] = place;
    }
    for (std::size_t i = 0; i < out_.size(); ++i) out_[i] = with_ends(out_[i], starts[i], stops[i]);
  }

  /// Where two pieces cross if they are led on, or the middle between their ends.
  [[nodiscard]] Vec2 meeting_place(const Piece& before, const Piece& behind) const {
    const Vec2 middle = 0.5 * (end_point(before) + start_point(behind));
    if (end_point(before) == start_point(behind)) return middle;
    Vec2 best = middle;
    double nearest = within_;
    for (const Vec2 p : crossings_of(before, behind)) {
      if (!(norm(p - middle) < nearest)) continue;
      nearest = norm(p - middle);
      best = p;
    }
    return best;
  }

  /// The same turn between ends that are nearly the same.
  static Piece with_ends(const Piece& piece, Vec2 start, Vec2 end) {
    if (start == start_point(piece) && end == end_point(piece)) return piece;
    const auto* arc = std::get_if<ArcPiece>(&piece);
    if (arc == nullptr) return LinePiece{start, end};
    return turned_by(start, end, arc->kappa * arc->length);
  }

  static Piece turned_by(Vec2 start, Vec2 end, double turn) {
    const Vec2 chord = end - start;
    const double kappa = 2.0 * std::sin(0.5 * turn) / norm(chord);
    return ArcPiece{start, end, heading(chord) - 0.5 * turn, kappa, turn / kappa};
  }

  /// A piece that stands for some, with places of them.
  struct Row {
    Piece piece;
    std::vector<Vec2> places;
  };

  static Row row_of(const Piece& piece) {
    return {piece, {start_point(piece), evaluate(piece, 0.5).point, end_point(piece)}};
  }

  /// Neighbours on one line or circle become one piece: circles are printed in parts.
  void join() {
    std::map<std::pair<double, double>, std::size_t> begins;
    std::vector<bool> has_before(out_.size());
    for (std::size_t i = 0; i < out_.size(); ++i) {
      const Vec2 at = start_point(out_[i]);
      begins.emplace(std::pair(at.x, at.y), i);
    }
    const auto behind = [&](std::size_t i) {
      const Vec2 at = end_point(out_[i]);
      const auto found = begins.find(std::pair(at.x, at.y));
      return found == begins.end() ? out_.size() : found->second;
    };
    for (std::size_t i = 0; i < out_.size(); ++i) {
      const std::size_t next = behind(i);
      if (next < out_.size()) has_before[next] = true;
    }
    std::vector<Piece> joined;
    std::vector<bool> done(out_.size());
    const auto take_from = [&](std::size_t first) {
      std::vector<Row> rows;
      for (std::size_t i = first; i < out_.size() && !done[i]; i = behind(i)) {
        done[i] = true;
        const Row own = row_of(out_[i]);
        if (rows.empty() || !taken_in(rows.back(), own)) rows.push_back(own);
      }
      while (rows.size() > 1 && taken_in(rows.back(), rows.front())) rows.erase(rows.begin());
      for (Row& row : rows) joined.push_back(std::move(row.piece));
    };
    for (std::size_t i = 0; i < out_.size(); ++i) {
      if (!has_before[i]) take_from(i);
    }
    for (std::size_t i = 0; i < out_.size(); ++i) {
      if (!done[i]) take_from(i);
    }
    out_ = std::move(joined);
  }

  [[nodiscard]] bool taken_in(Row& row, const Row& next) const {
    if (end_point(row.piece) != start_point(next.piece)) return false;
    std::vector<Vec2> places = row.places;
    places.insert(places.end(), next.places.begin(), next.places.end());
    const auto piece = both(row.piece, next.piece, places);
    if (!piece) return false;
    const bool near = std::all_of(places.begin(), places.end(), [&](Vec2 p) {
      return distance_from(*piece, p) <= kOneCircle * within_;
    });
    if (!near) return false;
    row = {*piece, std::move(places)};
    return true;
  }

  [[nodiscard]] static std::optional<Piece> both(const Piece& one, const Piece& next,
                                                 const std::vector<Vec2>& places) {
    const Vec2 start = start_point(one), end = end_point(next);
    const auto *a = std::get_if<ArcPiece>(&one), *b = std::get_if<ArcPiece>(&next);
    if ((a == nullptr) != (b == nullptr)) return std::nullopt;
    if (a == nullptr) {
      const bool forward = dot(end_point(one) - start, end - end_point(one)) > 0.0;
      return forward ? std::optional<Piece>(LinePiece{start, end}) : std::nullopt;
    }
    if (a->kappa * b->kappa <= 0.0) return std::nullopt;
    const double turn = a->kappa * a->length + b->kappa * b->length;
    if (start == end) {
      const auto circle = circle_of_squares(places);
      if (!circle || std::abs(std::abs(turn) - 4.0 * kQuarterTurn) > kQuarterTurn) {
        return std::nullopt;
      }
      const double side = turn > 0.0 ? 1.0 : -1.0, theta = heading(start - circle->centre);
      const Vec2 from = circle->centre + circle->radius * unit_at(theta);
      return ArcPiece{from, from, theta + side * kQuarterTurn, side / circle->radius,
                      4.0 * kQuarterTurn * circle->radius};
    }
    if (std::abs(turn) > 3.5 * kQuarterTurn) return std::nullopt;  // its chord says too little
    return turned_by(start, end, turn);
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
