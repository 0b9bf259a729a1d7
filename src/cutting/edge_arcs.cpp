// SPDX-License-Identifier: Apache-2.0
// Arcs in place of many short edges: docs/methods/cutting.md.
#include "edge_arcs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/geom/internal/circle.h"

namespace obvid::cutting {
namespace {

constexpr double kCornerTurn = std::numbers::pi / 6.0;  // more is no vertex of a curve
constexpr std::size_t kPartsOfEdge = 4;                 // places of an edge that are looked at
constexpr double kBetweenPlaces = 0.98;  // of what is allowed: what lies between them
constexpr double kMostHalfTurn = 1.5;    // rad, of an arc: it turns by less than half a turn

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

  /// Calls for places of the edges between two vertices, with a unit vector across the edge.
  template <class Place>
  bool each_place(std::size_t from, std::size_t to, const Place& place) const {
    const Vec2 chord = vertices_[to] - vertices_[from];
    const double length = norm(chord);
    if (!(length > 0.0)) return false;
    double before = 0.0;
    for (std::size_t k = from; k < to; ++k) {
      const Vec2 edge = vertices_[k + 1] - vertices_[k];
      const Vec2 across = left_normal(edge) / norm(edge);
      for (std::size_t part = 1; part <= kPartsOfEdge; ++part) {
        if (k + 1 == to && part == kPartsOfEdge) break;
        const Vec2 at = vertices_[k] + (static_cast<double>(part) / kPartsOfEdge) * edge;
        const double along = dot(chord, at - vertices_[from]) / length;
        if (!(along > before && along < length) || !place(at, across)) return false;
        before = along;
      }
    }
    return true;
  }

  /// An arc or line between two vertices that the edges between them stay near. The angle at which
  /// any place of an arc sees its ends is half of its turn: places beside the edges bound it.
  [[nodiscard]] std::optional<Fit> over(std::size_t from, std::size_t to) const {
    const Vec2 a = vertices_[from], b = vertices_[to];
    double low = -HUGE_VAL, high = HUGE_VAL;
    const auto half_turn = [&](Vec2 p) { return turning(p - a, b - p); };
    const bool any = each_place(from, to, [&](Vec2 at, Vec2 across) {
      const double left = half_turn(at + within_ * across),
                   right = half_turn(at - within_ * across);
      low = std::max(low, std::min(left, right));
      high = std::min(high, std::max(left, right));
      return low <= high;
    });
    if (!any) return std::nullopt;
    const double half = low <= 0.0 && high >= 0.0 ? 0.0 : 0.5 * (low + high);
    if (std::abs(half) > kMostHalfTurn) return std::nullopt;
    Fit out{between(a, b, half), 0.0};
    const double kappa = curvature_of(out.piece);
    const double theta = heading_at_start(out.piece);
    const bool near = each_place(from, to, [&](Vec2 at, Vec2) {
      out.off = std::max(out.off, distance_from_circle(a, theta, kappa, at));
      return out.off <= within_;
    });
    out.off /= kBetweenPlaces;
    return near ? std::optional(std::move(out)) : std::nullopt;
  }

  /// The arc that turns by twice the angle.
  static Piece between(Vec2 a, Vec2 b, double half) {
    if (half == 0.0) return LinePiece{a, b};
    const Vec2 chord = b - a;
    const double kappa = 2.0 * std::sin(half) / norm(chord);
    return ArcPiece{a, b, heading(chord) - half, kappa, 2.0 * half / kappa};
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
