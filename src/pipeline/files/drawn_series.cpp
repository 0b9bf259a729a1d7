// SPDX-License-Identifier: Apache-2.0
// Curves of drawings as series: docs/methods/drawings.md.
#include "files/drawn_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "files/drawn_pieces.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"
#include "obvid/series/analysis.h"
#include "obvid/series/internal/sections.h"
#include "verify/report.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kChordTolerance = 1e-4;  // of the size of a curve
constexpr int kMostSteps = 4096;          // chords of one piece
/// Beside a piece that stays a curve is given at four places inside at least, and by chords no
/// farther from it than this part of its own length: a rounding may be small in a large drawing.
constexpr int kFewestSteps = 4;
constexpr double kOwnTolerance = 1e-3;
/// A curve that leaves a piece by a smaller turn was meant to be tangent, rad: a twentieth of a
/// degree, which splines of CAD systems keep by far and the eye does not see.
constexpr double kTangent = 1e-3;
/// Curvatures that agree so far, of the larger one, were meant to be the same.
constexpr double kSameBend = 1e-3;
/// The chord beside a piece that stays turns away from it by half the turn between chords when the
/// piece is its tangent; what turns by more than this many of the next turns is a corner.
constexpr double kChordTurns = 1.5;

std::vector<Vec2> places_on(const DrawnCurve& curve) {
  std::vector<Vec2> out;
  for (const Piece& piece : curve.pieces) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) out.push_back(evaluate(piece, t).point);
  }
  return out;
}

class SeriesOfDrawing {
 public:
  SeriesOfDrawing(std::vector<DrawnPiece> pieces, bool closed, double chord)
      : pieces_(std::move(pieces)), closed_(closed), chord_(chord) {
    any_kept_ =
        std::any_of(pieces_.begin(), pieces_.end(), [](const DrawnPiece& one) { return one.kept; });
  }

  PointSeries run() {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      joint_.push_back(out_.points.size());
      if (pieces_[i].kept) out_.kept.push_back({out_.points.size(), pieces_[i].piece});
      add_points(pieces_[i]);
    }
    joint_.push_back(out_.points.size());
    out_.points.push_back(closed_ ? out_.points.front() : end_point(pieces_.back().piece));
    out_.fixed.resize(out_.points.size());
    for (std::size_t j = closed_ ? 0 : 1; j < pieces_.size(); ++j) look_at_joint(j);
    if (closed_) out_.fixed.back() = out_.fixed.front();
    return std::move(out_);
  }

 private:
  /// The piece without its end.
  void add_points(const DrawnPiece& one) {
    const Piece& piece = one.piece;
    int steps = 1;
    if (!one.kept && !std::holds_alternative<LinePiece>(piece)) {
      steps = any_kept_ ? kFewestSteps : 2;
      const double own = kOwnTolerance * norm(end_point(piece) - start_point(piece));
      const double within = any_kept_ && own > 0.0 ? std::min(chord_, own) : chord_;
      steps = chord_steps(piece, within, steps, kMostSteps);
    }
    out_.points.push_back(start_point(piece));
    for (int k = 1; k < steps; ++k) {
      out_.points.push_back(evaluate(piece, static_cast<double>(k) / steps).point);
    }
  }

  /// Marks a corner, or fixes the tangent of what is kept for the curve beside it.
  void look_at_joint(std::size_t j) {
    const std::size_t n = pieces_.size();
    const DrawnPiece &before = pieces_[(j + n - 1) % n], &after = pieces_[j];
    const Element in = element_at(before.piece, 1.0), out = element_at(after.piece, 0.0);
    const double turn = std::abs(turn_between(in.theta, out.theta));
    FixedData& fixed = out_.fixed[joint_[j]];
    if (before.kept == after.kept) {
      // between points a search decides about what turns less
      fixed.corner = turn > (before.kept ? kTangentTurn : kDefaultCornerAngle) &&
                     !(is_chord(before) && is_chord(after));
      return;
    }
    const DrawnPiece& curve = before.kept ? after : before;
    const Element& kept = before.kept ? in : out;
    const Element& other = before.kept ? out : in;
    const double allowed = is_chord(curve) ? kChordTurns * next_turn(j, before.kept) : kTangent;
    fixed.corner = !(turn <= allowed);  // also where the curve has no heading there
    if (fixed.corner) return;
    fixed.theta = kept.theta;
    const double larger = std::max(std::abs(kept.kappa), std::abs(other.kappa));
    if (!is_chord(curve) && std::isfinite(larger) &&
        std::abs(kept.kappa - other.kappa) <= kSameBend * larger) {
      fixed.kappa = kept.kappa;
    }
  }

  static bool is_chord(const DrawnPiece& one) {
    return !one.kept && std::holds_alternative<LinePiece>(one.piece);
  }

  /// Turn between the first two chords beyond a joint.
  [[nodiscard]] double next_turn(std::size_t j, bool forwards) const {
    const std::size_t n = pieces_.size();
    const DrawnPiece& first = pieces_[forwards ? j : (j + n - 1) % n];
    const DrawnPiece& second = pieces_[forwards ? (j + 1) % n : (j + n - 2) % n];
    if (!is_chord(first) || !is_chord(second)) return 0.0;
    return std::abs(
        turn_between(element_at(first.piece, 0.0).theta, element_at(second.piece, 0.0).theta));
  }

  std::vector<DrawnPiece> pieces_;
  bool closed_;
  double chord_;
  bool any_kept_ = false;
  std::vector<std::size_t> joint_;  ///< index of the point at the start of each piece
  PointSeries out_;
};

/// Whatever is drawn, as points.
std::vector<DrawnPiece> nothing_kept(const DrawnCurve& curve) {
  std::vector<DrawnPiece> out;
  for (const Piece& piece : curve.pieces) out.push_back({piece, false});
  return out;
}

/// A closed curve of two pieces has too few points to be known as one.
void cut_into_three(std::vector<DrawnPiece>& pieces) {
  while (pieces.size() < 3) {
    std::vector<DrawnPiece> parts;
    for (const DrawnPiece& one : pieces) {
      const Vec2 middle = evaluate(one.piece, 0.5).point;
      if (const auto* arc = std::get_if<ArcPiece>(&one.piece)) {
        const double half = 0.5 * arc->length;
        parts.push_back({ArcPiece{arc->start, middle, arc->theta0, arc->kappa, half}, one.kept});
        parts.push_back(
            {ArcPiece{middle, arc->end, arc->theta0 + half * arc->kappa, arc->kappa, half},
             one.kept});
      } else if (const auto* line = std::get_if<LinePiece>(&one.piece)) {
        parts.push_back({LinePiece{line->start, middle}, one.kept});
        parts.push_back({LinePiece{middle, line->end}, one.kept});
      } else {
        parts.push_back({one.piece, false});
      }
    }
    if (parts.size() == pieces.size()) return;
    pieces = std::move(parts);
  }
}

}  // namespace

PointSeries series_of(const DrawnCurve& curve, DrawnUse use, std::optional<double> chord) {
  const double size = bounding_diagonal(places_on(curve));
  const double tolerance = chord.value_or(kChordTolerance * size);
  if (use == DrawnUse::kPoints) {
    return SeriesOfDrawing(nothing_kept(curve), curve.closed, tolerance).run();
  }
  std::vector<DrawnPiece> pieces = drawn_pieces(curve, use == DrawnUse::kExact);
  if (curve.closed) cut_into_three(pieces);
  const bool any =
      std::any_of(pieces.begin(), pieces.end(), [](const DrawnPiece& one) { return one.kept; });
  if (!any) return SeriesOfDrawing(nothing_kept(curve), curve.closed, tolerance).run();
  if (const double gap = join_ends(pieces, curve.closed, size); gap > 0.0) {
    PointSeries out = SeriesOfDrawing(nothing_kept(curve), curve.closed, tolerance).run();
    out.warnings.push_back(
        fmt::format("pieces of the drawing are up to {:.3g} apart and cannot stay as they are: "
                    "points were taken of all of them",
                    gap * size));
    return out;
  }
  open_vertices(pieces);
  return SeriesOfDrawing(std::move(pieces), curve.closed, tolerance).run();
}

}  // namespace obvid::pipeline_detail
