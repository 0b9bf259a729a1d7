// SPDX-License-Identifier: Apache-2.0
#include "outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/core/internal/figures.h"

namespace obvid::cutting {
namespace {

/// Of the tolerance, for arcs in place of contours; printing takes the rest.
constexpr double kOfTolerance = 0.5;
/// Places on a path that are looked at: of the tool's radius, how far apart.
constexpr double kClearApart = 0.2;
/// Of the tolerance, what drawings whose pieces meet with small turns may cost.
constexpr double kSmallTurns = 0.1;

Box2 box_around(const ArcPath& path) {
  constexpr int kParts = 8;
  Box2 out;
  double beyond = 0.0;  // of an arc, its chords
  for (const Piece& piece : path.pieces) {
    for (int k = 0; k <= kParts; ++k)
      out.add(evaluate(piece, static_cast<double>(k) / kParts).point);
    const double kappa = std::abs(curvature_of(piece)), part = length_of(piece) / kParts;
    beyond = std::max(beyond, kappa * part * part / 8.0);
  }
  out.low = out.low - Vec2{beyond, beyond};
  out.high = out.high + Vec2{beyond, beyond};
  return out;
}

double distance_from_box(const Box2& box, Vec2 p) {
  return norm(Vec2{std::max({box.low.x - p.x, 0.0, p.x - box.high.x}),
                   std::max({box.low.y - p.y, 0.0, p.y - box.high.y})});
}

bool boxes_meet(const Box2& a, const Box2& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Angle that a piece turns around a point, rad: chords so short that the point is on the same side
/// of chord and arc.
double turn_around(const Piece& piece, Vec2 point) {
  const double away = distance_from(piece, point), kappa = std::abs(curvature_of(piece));
  const double turn = kappa * length_of(piece);
  const double depth = std::min(1.0, 0.5 * away * kappa);
  const double widest = std::max(1e-3, 2.0 * std::acos(1.0 - depth));
  const int parts = std::max(turn > 0.0 ? 8 : 1, static_cast<int>(std::ceil(turn / widest)));
  double sum = 0.0;
  Vec2 last = start_point(piece);
  for (int k = 1; k <= parts; ++k) {
    const Vec2 next =
        k == parts ? end_point(piece) : evaluate(piece, static_cast<double>(k) / parts).point;
    sum += turning(last - point, next - point);
    last = next;
  }
  return sum;
}

class Tracks {
 public:
  Tracks(const std::vector<CutOutline>& outlines, const CutOptions& options, double scale,
         Watch& watch)
      : outlines_(outlines), options_(options), scale_(scale), watch_(watch) {}

  Result<std::vector<Track>> run() {
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
      if (watch_.cancelled()) return fail(cancelled_error());
      OBVID_TRY(add(i));
    }
    nest();
    for (Track& track : tracks_) OBVID_TRY(compensate(track));
    for (const Track& track : tracks_) {
      if (watch_.cancelled()) return fail(cancelled_error());
      OBVID_TRY(keeps_clear(track));
    }
    return std::move(tracks_);
  }

 private:
  Result<void> add(std::size_t i) {
    const Contour& contour = outlines_[i].contour;
    auto along = arcs_along(contour, kOfTolerance * options_.tolerance, &watch_);
    if (!along) return fail(named(along.error(), outlines_[i].name));
    Track track;
    track.outline = i;
    track.name = outlines_[i].name;
    track.deviation = along->deviation * scale_;
    for (const Piece& piece : along->pieces) track.edge.pieces.push_back(scaled(piece, scale_));
    track.edge.closed = contour.closed;
    if (track.edge.closed && area_of(track.edge) == 0.0) track.edge.closed = false;
    track.room = box_around(track.edge);
    tracks_.push_back(std::move(track));
    return {};
  }

  static Error named(Error error, const std::string& name) {
    error.where = error.where.empty() ? name : name + ", " + error.where;
    return error;
  }

  void nest() {
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      Track& one = tracks_[i];
      const Vec2 p = evaluate(one.edge.pieces.front(), 0.5).point;
      for (std::size_t j = 0; j < tracks_.size(); ++j) {
        if (i == j || !tracks_[j].edge.closed || !is_inside(tracks_[j].edge, p)) continue;
        ++one.around;
        tracks_[j].first.push_back(i);
      }
    }
  }

  Result<void> compensate(Track& track) {
    const bool wanted = options_.diameter > 0.0 && options_.side != CutSide::kOn;
    if (wanted && track.edge.closed) {
      const bool outside = options_.side == CutSide::kOutside ||
                           (options_.side == CutSide::kAuto && track.around % 2 == 0);
      track.side = outside ? CutSide::kOutside : CutSide::kInside;
      // what stays lies to the right
      if ((area_of(track.edge) < 0.0) != outside) track.edge = reversed(track.edge);
    } else if (wanted && options_.side != CutSide::kAuto) {
      return error(ErrorCode::kBadOption, "an open curve has no inside")
          .where(track.name)
          .hint("leave --side out, or close the curve in the drawing");
    }
    const bool compensated = track.side != CutSide::kOn;
    auto parallel = parallel_of(track.edge, compensated ? 0.5 * options_.diameter * scale_ : 0.0);
    if (!parallel) return fail(in_drawing(parallel.error(), track.name));
    track.axis = std::move(parallel->path);
    track.corners = std::move(parallel->corners);
    if (compensated && options_.direction == CutDirection::kConventional) {
      track.axis = reversed(track.axis);
    }
    return {};
  }

  /// Lengths in messages are those of the machine, which are other ones for a drawing in metres.
  [[nodiscard]] Error in_drawing(Error error, const std::string& name) const {
    if (scale_ != 1.0) error.hint += error.hint.empty() ? "" : " (lengths as in the program)";
    return named(std::move(error), name);
  }

  /// No place of the axis is nearer to an edge than the tool is wide.
  Result<void> keeps_clear(const Track& track) const {
    if (track.side == CutSide::kOn) return {};
    const double radius = 0.5 * options_.diameter * scale_;
    const double slack = kSmallTurns * options_.tolerance * scale_;
    for (const Piece& piece : track.axis.pieces) {
      const double length = length_of(piece);
      const int parts = std::max(2, static_cast<int>(std::ceil(length / (kClearApart * radius))));
      for (int k = 0; k <= parts; ++k) {
        const Vec2 p = evaluate(piece, static_cast<double>(k) / parts).point;
        const double room = distance_from_edges(tracks_, p);
        if (room >= radius - slack) continue;
        OBVID_TRY(crosses_none(track));
        return error(ErrorCode::kToolTooLarge,
                     fmt::format("the tool does not fit: it would cut {} deep into what stays",
                                 significant(radius - room, 3)))
            .where(
                fmt::format("{}, at {}, {}", track.name, significant(p.x, 6), significant(p.y, 6)))
            .hint("choose a smaller cutter, or another --side")
            .value(room);
      }
    }
    return {};
  }

  /// What the outlines themselves do not leave room for.
  Result<void> crosses_none(const Track& track) const {
    for (const Track& other : tracks_) {
      if (&other == &track || other.side == CutSide::kOn || !boxes_meet(track.room, other.room))
        continue;
      for (const Piece& a : track.edge.pieces) {
        for (const Piece& b : other.edge.pieces) {
          if (!meeting_of(a, b)) continue;
          return error(
                     ErrorCode::kToolTooLarge,
                     fmt::format("two outlines cross or touch: {} and {}", track.name, other.name))
              .hint("leave one of them out (--curve), or cut along them (--side on)");
        }
      }
    }
    return {};
  }

  const std::vector<CutOutline>& outlines_;
  const CutOptions& options_;
  double scale_;
  Watch& watch_;
  std::vector<Track> tracks_;
};

}  // namespace

bool is_inside(const ArcPath& path, Vec2 point) {
  double turn = 0.0;
  for (const Piece& piece : path.pieces) turn += turn_around(piece, point);
  return std::abs(turn) > std::numbers::pi;
}

double distance_from_edges(const std::vector<Track>& tracks, Vec2 point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Track& track : tracks) {
    if (track.side == CutSide::kOn || distance_from_box(track.room, point) >= nearest) continue;
    for (const Piece& piece : track.edge.pieces) {
      // an arc is no farther from its start than its length
      const double at_least = norm(point - start_point(piece)) - length_of(piece);
      if (at_least < nearest) nearest = std::min(nearest, distance_from(piece, point));
    }
  }
  return nearest;
}

Result<std::vector<Track>> tracks_of(const std::vector<CutOutline>& outlines,
                                     const CutOptions& options, double scale, Watch& watch) {
  return Tracks(outlines, options, scale, watch).run();
}

}  // namespace obvid::cutting
