// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "obvid/contour/arcs.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/region/refine.h"

namespace obvid {
namespace {

constexpr int kSamples = 24;           // of a pair of arcs
constexpr double kOfTolerance = 0.97;  // what lies between the samples
constexpr int kHalvings = 12;          // of the place where a pair ends
constexpr double kShortest = 0x1p-30;  // of a piece: arcs of that length are rounding
constexpr double kMostTurn = 1.5;      // of a pair, rad: the arcs stay well below half a turn

/// Distance of a point from an arc or line, seen from its start.
double distance_from(const Piece& piece, Vec2 p) {
  if (const auto* line = std::get_if<LinePiece>(&piece)) {
    const Vec2 along = line->end - line->start, v = p - line->start;
    const double t = std::clamp(dot(v, along) / dot(along, along), 0.0, 1.0);
    return norm(v - t * along);
  }
  const auto& arc = std::get<ArcPiece>(piece);
  const Vec2 v = p - arc.start, n = left_normal(unit_at(arc.theta0));
  // | |p - centre| - radius | without the cancellation of a large circle
  const double signed_offset = 0.5 * arc.kappa * dot(v, v) - dot(v, n);
  const double to_centre = norm(arc.kappa * v - n);
  return std::abs(2.0 * signed_offset) / (1.0 + to_centre);
}

/// Two arcs with tangents of equal length at both ends (Bolton, "Biarc curves", 1975): always there
/// for headings less than half a turn apart.
std::array<Piece, 2> equal_legs(const Element& a, const Element& b) {
  const Vec2 v = b.point - a.point, t0 = unit_at(a.theta), t1 = unit_at(b.theta), t = t0 + t1;
  const double denominator = 2.0 * (1.0 - dot(t0, t1));
  const double vt = dot(v, t), vv = dot(v, v);
  const double root = std::sqrt(vt * vt + denominator * vv);
  const double leg = vv / (vt + root);
  const Vec2 middle = 0.5 * (a.point + b.point + leg * (t0 - t1));
  const auto arc = [](Vec2 from, double theta, Vec2 to) -> Piece {
    const Vec2 chord = to - from;
    const double half = turning(unit_at(theta), chord), length = norm(chord);
    if (half == 0.0) return LinePiece{from, to};
    const double kappa = 2.0 * std::sin(half) / length;
    return ArcPiece{from, to, theta, kappa, 2.0 * half / kappa};
  };
  const double theta = a.theta + 2.0 * turning(t0, middle - a.point);
  return {arc(a.point, a.theta, middle), arc(middle, theta, b.point)};
}

/// Places along a contour: piece i at parameter t is the place i + t.
class Along {
 public:
  Along(const Contour& contour, double tolerance)
      : contour_(contour), tolerance_(kOfTolerance * tolerance) {}

  Result<ArcsAlong> run() {
    for (std::size_t i = 0; i < contour_.pieces.size();) {
      if (is_exact(i)) {
        out_.pieces.push_back(contour_.pieces[i]);
        ++i;
        continue;
      }
      const std::size_t end = end_of_stretch(i);
      if (auto done = follow(i, end); !done) return fail(done.error());
      i = end;
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_exact(std::size_t i) const {
    return std::holds_alternative<LinePiece>(contour_.pieces[i]) ||
           std::holds_alternative<ArcPiece>(contour_.pieces[i]);
  }

  [[nodiscard]] int direction_of(std::size_t i) const {
    for (const Run& run : contour_.runs) {
      if (i >= run.first_piece && i <= run.last_piece) return run.direction;
    }
    return 0;
  }

  /// The first piece after `first` that is exact, begins at a corner, or changes another way.
  [[nodiscard]] std::size_t end_of_stretch(std::size_t first) const {
    const int direction = direction_of(first);
    std::size_t end = first + 1;
    for (; end < contour_.pieces.size(); ++end) {
      const bool corner = end < contour_.joints.size() && contour_.joints[end].leaving;
      if (corner || is_exact(end) || direction == 0 || direction_of(end) != direction) break;
    }
    return end;
  }

  struct Place {
    std::size_t piece = 0;
    double t = 0.0;
  };

  /// `from_left`: at a joint the end of the piece before it.
  [[nodiscard]] static Place split(double place, bool from_left) {
    auto piece = static_cast<std::size_t>(place);
    if (from_left && piece > 0 && static_cast<double>(piece) == place) --piece;
    return {piece, place - static_cast<double>(piece)};
  }

  [[nodiscard]] Element element(double place, bool from_left) const {
    const Place p = split(place, from_left);
    return element_at(contour_.pieces[p.piece], p.t);
  }

  struct Pair {
    std::array<Piece, 2> arcs;
    double deviation = 0.0;
  };

  [[nodiscard]] std::optional<Pair> attempt(double from, double to, int direction) const {
    const Element a = element(from, false);
    Element b = element(to, true);
    b.theta = a.theta + std::remainder(b.theta - a.theta, 2.0 * std::numbers::pi);
    if (std::abs(b.theta - a.theta) > kMostTurn) return std::nullopt;
    Pair pair;
    const auto curvatures =
        direction != 0 ? choose_biarc(chord_frame(a, b), direction) : std::nullopt;
    pair.arcs = curvatures ? biarc(a, b, *curvatures) : equal_legs(a, b);
    if (!forward(pair.arcs[0]) || !forward(pair.arcs[1])) return std::nullopt;
    const Vec2 middle = end_point(pair.arcs[0]);
    const Vec2 tangent = middle_tangent(pair.arcs);
    for (int k = 1; k < kSamples; ++k) {
      const double place = from + (to - from) * k / kSamples;
      const Place at = split(place, false);
      const Vec2 p = evaluate(contour_.pieces[at.piece], at.t).point;
      const bool first = dot(p - middle, tangent) <= 0.0;
      const double away = distance_from(pair.arcs[first ? 0 : 1], p);
      pair.deviation = std::max(pair.deviation, away);
      if (!(pair.deviation <= tolerance_)) return std::nullopt;
    }
    return pair;
  }

  [[nodiscard]] static bool forward(const Piece& piece) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    if (arc != nullptr) return arc->length > 0.0 && std::isfinite(arc->kappa);
    const auto& line = std::get<LinePiece>(piece);
    return !(line.start == line.end);
  }

  [[nodiscard]] static Vec2 middle_tangent(const std::array<Piece, 2>& arcs) {
    if (const auto* second = std::get_if<ArcPiece>(&arcs[1])) return unit_at(second->theta0);
    const auto& line = std::get<LinePiece>(arcs[1]);
    return line.end - line.start;
  }

  /// Pairs over the pieces [first, end), each as long as it may be.
  Result<void> follow(std::size_t first, std::size_t end) {
    const int direction = direction_of(first);
    const auto last = static_cast<double>(end);
    double from = static_cast<double>(first), step = 1.0;
    while (from < last) {
      double to = std::min(last, from + step);
      auto good = attempt(from, to, direction);
      double bad = last;
      while (!good && to - from > kShortest) {
        bad = to;
        to = from + 0.5 * (to - from);
        good = attempt(from, to, direction);
      }
      if (!good) {
        return fail({ErrorCode::kToleranceNotReached,
                     "no pair of arcs is near enough to the contour",
                     "piece " + std::to_string(static_cast<std::size_t>(from) + 1),
                     "allow a larger tolerance", static_cast<std::ptrdiff_t>(from), tolerance_});
      }
      lengthen(from, to, bad, last, direction, *good);
      out_.pieces.push_back(good->arcs[0]);
      out_.pieces.push_back(good->arcs[1]);
      out_.deviation = std::max(out_.deviation, good->deviation);
      step = to - from;
      from = to;
    }
    return {};
  }

  /// Moves the end of a pair that will do as far as it will.
  void lengthen(double from, double& to, double bad, double last, int direction, Pair& good) const {
    while (to < last && bad == last) {  // nothing was too long so far
      const double next = std::min(last, from + 2.0 * (to - from));
      auto longer = attempt(from, next, direction);
      if (!longer) {
        bad = next;
        break;
      }
      to = next;
      good = std::move(*longer);
    }
    for (int k = 0; k < kHalvings && to < last; ++k) {
      const double middle = 0.5 * (to + bad);
      auto longer = attempt(from, middle, direction);
      if (longer) {
        to = middle;
        good = std::move(*longer);
      } else {
        bad = middle;
      }
    }
  }

  const Contour& contour_;
  double tolerance_;
  ArcsAlong out_;
};

}  // namespace

Result<ArcsAlong> arcs_along(const Contour& contour, double tolerance) {
  if (!(tolerance > 0.0)) {
    return fail(
        {ErrorCode::kBadOption, "the tolerance must be greater than 0", "", "", -1, tolerance});
  }
  if (contour.pieces.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the contour has no pieces", "", "", -1, 0.0});
  }
  return Along(contour, tolerance).run();
}

}  // namespace obvid
