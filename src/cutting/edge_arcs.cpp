// SPDX-License-Identifier: Apache-2.0
// Arcs in place of many short edges: docs/methods/cutting.md.
#include "edge_arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace obvid::cutting {
namespace {

constexpr double kCornerTurn = std::numbers::pi / 6.0;  // more is no vertex of a curve
constexpr std::size_t kPartsOfEdge = 4;                 // places of an edge that are looked at
constexpr double kBetweenPlaces = 0.98;  // of what is allowed: what lies between them
constexpr double kFlattest = 0.9;  // of half its chord, what an arc may rise over it: no half turn

/// Vertices in a row, no corner among the inner ones.
class EdgeRow {
 public:
  EdgeRow(std::vector<Vec2> vertices, double within)
      : vertices_(std::move(vertices)), within_(kBetweenPlaces * within) {}

  void replace(ArcPath& out, double& deviation) const {
    const std::size_t last = vertices_.size() - 1;
    for (std::size_t from = 0; from < last;) {
      std::size_t to = from + 1, bad = last + 1, step = 1;
      std::optional<Fit> best;
      while (to < last) {
        const std::size_t next = std::min(last, to + step);
        if (next >= bad) break;
        if (auto fit = over(from, next)) {
          best = fit;
          to = next;
          step *= 2;
        } else {
          bad = next;
          break;
        }
      }
      while (bad <= last && bad - to > 1) {
        const std::size_t middle = to + (bad - to) / 2;
        if (auto fit = over(from, middle)) {
          best = fit;
          to = middle;
        } else {
          bad = middle;
        }
      }
      const Vec2 a = vertices_[from], b = vertices_[to];
      out.pieces.push_back(best ? best->piece : Piece(LinePiece{a, b}));
      if (best) deviation = std::max(deviation, best->off);
      from = to;
    }
  }

 private:
  struct Fit {
    Piece piece;
    double off = 0.0;
  };

  /// Calls for places of the edges between two vertices, along the chord and to its left.
  template <class Place>
  bool each_place(std::size_t from, std::size_t to, const Place& place) const {
    const Vec2 chord = vertices_[to] - vertices_[from];
    const double length = norm(chord);
    if (!(length > 0.0)) return false;
    const Vec2 along = chord / length;
    double before = 0.0;
    for (std::size_t k = from; k < to; ++k) {
      for (std::size_t part = 1; part <= kPartsOfEdge; ++part) {
        if (k + 1 == to && part == kPartsOfEdge) break;
        const double share = static_cast<double>(part) / kPartsOfEdge;
        const Vec2 v = vertices_[k] + share * (vertices_[k + 1] - vertices_[k]) - vertices_[from];
        const Vec2 at{dot(along, v), cross(along, v)};
        if (!(at.x > before && at.x < length) || !place(at, length)) return false;
        before = at.x;
      }
    }
    return true;
  }

  /// An arc or line between two vertices that the edges between them stay near.
  [[nodiscard]] std::optional<Fit> over(std::size_t from, std::size_t to) const {
    // a place at x with height y is off an arc with the rise h over its chord by about
    // y - 4 h x (l - x) / l^2: rises that leave no place farther than allowed
    double low = -HUGE_VAL, high = HUGE_VAL, half = 0.0;
    const bool any = each_place(from, to, [&](Vec2 at, double length) {
      half = 0.5 * length;
      const double share = 4.0 * at.x * (length - at.x) / (length * length);
      low = std::max(low, (at.y - within_) / share);
      high = std::min(high, (at.y + within_) / share);
      return true;
    });
    if (!any || low > high) return std::nullopt;
    const double rise = low <= 0.0 && high >= 0.0 ? 0.0 : 0.5 * (low + high);
    if (std::abs(rise) > kFlattest * half) return std::nullopt;
    Fit out{between(vertices_[from], vertices_[to], rise), 0.0};
    const double bend = -curvature_of(out.piece);
    const bool near = each_place(from, to, [&](Vec2 at, double length) {
      // off the circle whose top lies over the middle of the chord
      const Vec2 v{at.x - 0.5 * length, at.y - rise};
      const double twice = 2.0 * v.y + bend * dot(v, v);
      const double both = 1.0 + norm(Vec2{bend * v.x, 1.0 + bend * v.y});
      out.off = std::max(out.off, std::abs(twice) / both);
      return out.off <= within_;
    });
    out.off /= kBetweenPlaces;
    return near ? std::optional(std::move(out)) : std::nullopt;
  }

  /// The arc that rises so far over the middle of its chord, to its left.
  static Piece between(Vec2 a, Vec2 b, double rise) {
    if (rise == 0.0) return LinePiece{a, b};
    const Vec2 chord = b - a;
    const double quarter = std::atan2(2.0 * rise, norm(chord)), half = 2.0 * quarter;
    const double kappa = -2.0 * std::sin(half) / norm(chord);
    return ArcPiece{a, b, heading(chord) + half, kappa, -2.0 * half / kappa};
  }

  std::vector<Vec2> vertices_;
  double within_;
};

bool turns_little(const Piece& before, const Piece& behind) {
  const Vec2 in = end_point(before) - start_point(before);
  const Vec2 out = end_point(behind) - start_point(behind);
  return std::abs(turning(in, out)) <= kCornerTurn;
}

bool is_an_edge(const Piece& piece) { return std::holds_alternative<LinePiece>(piece); }

}  // namespace

EdgeArcs arcs_over_edges(const ArcPath& path, double within) {
  EdgeArcs out;
  out.path.closed = path.closed;
  const std::vector<Piece>& pieces = path.pieces;
  for (std::size_t k = 0; k < pieces.size();) {
    if (!is_an_edge(pieces[k])) {
      out.path.pieces.push_back(pieces[k++]);
      continue;
    }
    std::vector<Vec2> vertices{start_point(pieces[k]), end_point(pieces[k])};
    for (++k; k < pieces.size() && is_an_edge(pieces[k]) && turns_little(pieces[k - 1], pieces[k]);
         ++k) {
      vertices.push_back(end_point(pieces[k]));
    }
    EdgeRow(std::move(vertices), within).replace(out.path, out.deviation);
  }
  return out;
}

}  // namespace obvid::cutting
