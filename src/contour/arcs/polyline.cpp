// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include "obvid/contour/arcs/polyline_along.h"
#include "obvid/curve/internal/path_distance.h"
#include "peak.h"
#include "track.h"

namespace obvid {
namespace {

using arcs::peak;
using arcs::Track;

constexpr double kMostPoints = 1e7;
constexpr double kOfChordTolerance = 0.99;  // what sampling may miss
constexpr double kAccuracy = 0.01;          // of a chord: how exactly its end is found
constexpr double kShortestChord = 1e-13;    // of a contour: chords of that length are rounding
constexpr int kChordSamples = 8;            // beside a chord, and at least two of each piece
constexpr double kMostChordTurn = 1.5;      // of the contour beside a chord, rad

class Chords {
 public:
  Chords(const Track& track, double tolerance, Watch* watch)
      : track_(track), tolerance_(tolerance), watch_(watch) {}

  /// Appends the points after the first one. False when no chord is near enough, or at the end that
  /// the watch says.
  bool follow(double from, double to, std::vector<Vec2>& out) const {
    double span = to - from;
    const double least = kShortestChord * track_.length();
    for (double s = from; to - s > least;) {
      const double step = longest(s, to, std::max(span, least), least);
      if (is_to_end(watch_)) return false;
      if (step == 0.0 || static_cast<double>(out.size()) > kMostPoints) return false;
      span = step;
      s = s + step < to ? s + step : to;
      out.push_back(track_.jet(s, true).point);
    }
    out.back() = track_.jet(to, true).point;
    return true;
  }

 private:
  [[nodiscard]] bool near(double a, double b) const {
    const Vec2 start = track_.jet(a, false).point, chord = track_.jet(b, true).point - start;
    const double length = norm(chord);
    if (!(length > 0.0)) return false;
    const Vec2 along = chord / length;
    const Track::Place first = track_.place(a, false), last = track_.place(b, true);
    const std::size_t pieces = last.piece - first.piece + 1;
    const int each =
        std::max(2, kChordSamples / static_cast<int>(std::min<std::size_t>(pieces, kChordSamples)));
    double before = 0.0, here = 0.0;
    for (std::size_t i = first.piece; i <= last.piece; ++i) {
      const double s0 = std::max(a, track_.start_of(i));
      const double s1 = std::min(b, track_.start_of(i + 1));
      for (int k = 1; k <= each; ++k) {
        const Jet jet = track_.jet(s0 + (s1 - s0) * k / each, true);
        if (std::abs(turning(along, jet.d1)) > kMostChordTurn) return false;
        const double next = std::abs(cross(along, jet.point - start));
        if (!(std::max(next, peak(before, here, next)) <= tolerance_)) return false;
        before = here;
        here = next;
      }
    }
    return true;
  }

  /// Length of the longest chord from a place; 0: none.
  [[nodiscard]] double longest(double s, double to, double guess, double least) const {
    constexpr double kGrow = 1.4;
    const double room = to - s;
    const auto good_at = [&](double span) { return near(s, span < room ? s + span : to); };
    double span = std::min(guess, room), bad = 0.0;
    while (!good_at(span)) {
      bad = span;
      span /= kGrow;
      if (span < least) return 0.0;
    }
    while (bad == 0.0 && span < room) {
      const double next = std::min(room, kGrow * span);
      (good_at(next) ? span : bad) = next;
    }
    while (bad - span > kAccuracy * bad) {
      const double middle = 0.5 * (span + bad);
      (good_at(middle) ? span : bad) = middle;
    }
    return span;
  }

  const Track& track_;
  double tolerance_;
  Watch* watch_;
};

double expected_chords(const Contour& contour, double tolerance) {
  constexpr int kPlaces = 4;  // of a piece
  double sum = 0.0;
  for (const Piece& piece : contour.pieces) {
    for (int k = 0; k < kPlaces; ++k) {
      const Jet jet = evaluate(piece, (k + 0.5) / kPlaces);
      sum += norm(jet.d1) / kPlaces * std::sqrt(std::abs(curvature(jet)) / (8.0 * tolerance));
    }
  }
  return sum;
}

Error chords_not_near(double value) {
  return error(ErrorCode::kToleranceNotReached,
               "ten million chords are not near enough to the contour")
      .hint("allow a larger tolerance")
      .value(value);
}

std::vector<Piece> as_pieces(const std::vector<Vec2>& points) {
  std::vector<Piece> out;
  for (std::size_t i = 1; i < points.size(); ++i) {
    out.emplace_back(LinePiece{points[i - 1], points[i]});
  }
  return out;
}

}  // namespace

Result<PolylineAlong> polyline_along(const Contour& contour, double tolerance, Watch* watch) {
  if (!(tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0").value(tolerance);
  }
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  const double expected = expected_chords(contour, tolerance);
  if (!(expected <= kMostPoints)) return fail(chords_not_near(expected));
  const Track track(contour);
  constexpr int kTrials = 4;
  double within = kOfChordTolerance * tolerance;
  PolylineAlong out;
  for (int trial = 0; trial < kTrials; ++trial) {
    out.points.assign(1, start_point(contour.pieces.front()));
    for (const arcs::SmoothPart& stretch : track.stretches()) {
      const double from = track.start_of(stretch.first), to = track.start_of(stretch.end);
      const bool near = Chords(track, within, watch).follow(from, to, out.points);
      if (has_ended(watch)) return fail(cancelled_error());
      if (!near) return fail(chords_not_near(tolerance));
    }
    out.deviation = path_distance(contour.pieces, as_pieces(out.points), watch);
    if (has_ended(watch)) return fail(cancelled_error());
    if (out.deviation <= tolerance) return out;
    within *= kOfChordTolerance * tolerance / out.deviation;
  }
  return fail(chords_not_near(out.deviation));
}

}  // namespace obvid
