// SPDX-License-Identifier: Apache-2.0
#include "end_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "double_double.h"
#include "piece_facts.h"
#include "scaled_piece.h"

namespace obvid {
namespace {

/// Roundings that a stored number carries, in units of 2^-53 of its size: one half ulp from
/// storing it and a few from computing it.
constexpr double kStoredRoundings = 4.0;
constexpr double kStored = kStoredRoundings * kUnitRoundoff;

// Roundings of the evaluation below, in units of 2^-53 (docs/methods/certify.md, section 5). Sines
// and cosines are taken to be right to one ulp, which is two of these units.
constexpr double kOfDifference = 1.0;  // rad, of a direction: one rounding in each component
constexpr double kOfUnit = 3.0;        // rad, of a direction from sine and cosine
constexpr double kOfCurvature = 20.0;  // of a Bezier end, relative
constexpr double kOfChord = 12.0;      // of an arc's chord, relative to its length

double largest_coordinate(Vec2 v) { return std::max(std::abs(v.x), std::abs(v.y)); }

/// point + by, with what two doubles cannot say.
void place(EndData& end, Vec2 point, Vec2 by) {
  const DoubleDouble x = two_sum(point.x, by.x), y = two_sum(point.y, by.y);
  end.point = {x.hi, y.hi};
  end.rest = {x.lo, y.lo};
}

PieceEnds ends_of(const LinePiece& line) {
  PieceEnds ends;
  EndData& end = ends.start;
  end.direction = line.end - line.start;
  const double length = std::hypot(end.direction.x, end.direction.y);
  end.heading_error = kOfDifference * kUnitRoundoff;
  end.heading_rounding =
      kStored * (1.0 + (largest_coordinate(line.start) + largest_coordinate(line.end)) / length);
  ends.end = end;
  ends.start.point = line.start;
  ends.end.point = line.end;
  ends.start.point_rounding = kStored * largest_coordinate(line.start);
  ends.end.point_rounding = kStored * largest_coordinate(line.end);
  return ends;
}

/// What arcs and clothoids have in common: a heading `theta0` that turns by `turn` to the end, and
/// a stored end beside the one where the other numbers lead. What a piece says at its end is taken
/// from these, so the gap shows any contradiction. `chord_error`: in units of 2^-53 of the length.
template <class Curve>
PieceEnds ends_of_turning(const Curve& curve, double turn, Vec2 chord, double chord_error) {
  PieceEnds ends;
  const double theta1 = curve.theta0 + turn;
  // a short piece far from the origin: its points cannot say its heading better than this
  const Vec2 across = curve.end - curve.start;
  const double coordinates = largest_coordinate(curve.start) + largest_coordinate(curve.end);
  const double lever = coordinates / std::hypot(across.x, across.y);
  for (EndData* end : {&ends.start, &ends.end}) {
    end->heading_rounding = kStored * (1.0 + std::abs(curve.theta0) + std::abs(theta1) + lever);
    end->point_rounding = kStored * coordinates + end->heading_rounding * curve.length;
    end->heading_error = kOfUnit * kUnitRoundoff;
  }
  ends.start.point = curve.start;
  ends.start.direction = unit_at(curve.theta0);
  place(ends.end, curve.start, chord);
  ends.end.direction = unit_at(theta1);
  constexpr double kOfTurn = 3.0;  // three operations at the most
  ends.end.heading_error += kUnitRoundoff * (kOfTurn * std::abs(turn) + std::abs(theta1));
  ends.end.point_error = kUnitRoundoff * chord_error * curve.length;
  return ends;
}

PieceEnds ends_of(const ArcPiece& arc) {
  const double turn = arc.kappa * arc.length, half = 0.5 * turn;
  const double chord = std::abs(half) > kUnitRoundoff ? std::sin(half) / half : 1.0;
  const double middle = arc.theta0 + half;
  PieceEnds ends = ends_of_turning(arc, turn, arc.length * chord * unit_at(middle),
                                   kOfChord + std::abs(turn) + std::abs(middle));
  for (EndData* end : {&ends.start, &ends.end}) {
    end->kappa = arc.kappa;
    end->kappa_rounding = kStored * std::abs(arc.kappa);
  }
  return ends;
}

// Gauss-Legendre nodes and weights on [-1, 1], 8 points ([Abramowitz, Stegun 1964], table 25.4).
constexpr std::array<double, 4> kGaussNode = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873,
                                                0.2223810344533745, 0.1012285362903763};
/// rad. With it the remainder of the quadrature, (8!)^4 / (17 (16!)^3) times the 16th derivative of
/// exp(i theta) over the panel, is below 2e-16 of the panel, also where the curvature changes its
/// sign.
constexpr double kPanelTurn = 0.5;
constexpr double kQuadrature = 2.0;    // that remainder, in units of 2^-53
constexpr double kMostPanels = 128.0;  // ten full turns; a piece that is proved has less than one

int panels_of(double most_turn) {
  return 1 + static_cast<int>(std::min(kMostPanels, most_turn / kPanelTurn));
}

/// Where a clothoid leads, by quadrature: the proof does not use the formulas that built the piece.
Vec2 clothoid_chord(const ClothoidPiece& piece, int panels) {
  const double sharpness = (piece.kappa1 - piece.kappa0) / piece.length;
  const double half = 0.5 * piece.length / panels;
  Vec2 chord;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    for (std::size_t j = 0; j < kGaussNode.size(); ++j) {
      for (const double s : {middle - half * kGaussNode[j], middle + half * kGaussNode[j]}) {
        const double theta = piece.theta0 + s * (piece.kappa0 + 0.5 * sharpness * s);
        chord = chord + half * kGaussWeight[j] * unit_at(theta);
      }
    }
  }
  return chord;
}

PieceEnds ends_of(const ClothoidPiece& piece) {
  const double most = std::max(std::abs(piece.kappa0), std::abs(piece.kappa1)) * piece.length;
  const int panels = panels_of(most);
  constexpr double kPerPanel = 8.0;  // sums of one panel
  constexpr double kOfTheta = 6.0;   // of the turning part of an angle inside
  const double chord_error =
      kOfChord + kQuadrature + kPerPanel * panels + kOfTheta * most + std::abs(piece.theta0);
  PieceEnds ends = ends_of_turning(piece, 0.5 * (piece.kappa0 + piece.kappa1) * piece.length,
                                   clothoid_chord(piece, panels), chord_error);
  constexpr double kOfTurn = 3.0;  // of |kappa0 + kappa1|, which may cancel
  ends.end.heading_error += kUnitRoundoff * kOfTurn * most;
  ends.start.kappa = piece.kappa0;
  ends.end.kappa = piece.kappa1;
  for (EndData* end : {&ends.start, &ends.end}) {
    end->kappa_rounding = kStored * std::abs(end->kappa);
    constexpr double kOfSlope = 2.0;
    end->slope = (piece.kappa1 - piece.kappa0) / piece.length;
    end->slope_error = kOfSlope * kUnitRoundoff * std::abs(end->slope);
  }
  return ends;
}

/// Vector between two control points, without rounding.
struct Leg {
  DoubleDouble x, y;
};

Leg leg_of(const RationalBezier& piece, std::size_t from, std::size_t to, double scale) {
  const auto difference = [scale](double a, double b) {
    const DoubleDouble d = two_sum(b, -a);
    return DoubleDouble{scale * d.hi, scale * d.lo};
  };
  const Vec2 a = piece.offset[from], b = piece.offset[to];
  return {difference(a.x, b.x), difference(a.y, b.y)};
}

/// With v1, v2, v3 from the end on and L = |v1|, at either end (a curve read backwards has the same
/// slope): d kappa/ds = (n-1) w0 / (n^2 w1^4 L^6) F,
/// F = (n-2) w0 w1 w3 L^2 v1 x v3 - 3 w2 (v1 x v2) ((n-1) w0 w2 v1 . v2 - n w1^2 L^2).
/// F is a small difference where curvature changes slowly: double doubles, with a bound of the
/// error by the sum of the terms.
void add_slope(EndData& end, const RationalBezier& piece, bool at_start, double scale,
               const Leg& one, const Leg& two) {
  const int n = piece.degree;
  const auto at = [&](int j) { return static_cast<std::size_t>(at_start ? j : n - j); };
  const auto weight = [&](int j) { return DoubleDouble{piece.weight[at(j)], 0.0}; };
  const DoubleDouble w0 = weight(0), w1 = weight(1), w2 = weight(2);
  const DoubleDouble w3 = n > 2 ? weight(3) : DoubleDouble{};
  const Leg three = n > 2 ? leg_of(piece, at(0), at(3), scale) : Leg{};
  const auto cross_of = [&](const Leg& v) { return one.x * v.y - one.y * v.x; };
  const auto dot_of = [&](const Leg& v) { return one.x * v.x + one.y * v.y; };
  const auto reach = [](const Leg& v) { return std::abs(v.x.hi) + std::abs(v.y.hi); };
  const DoubleDouble square = dot_of(one);
  const DoubleDouble first = w0 * w1 * w3 * square * cross_of(three) * (n - 2);
  const DoubleDouble second =
      w2 * cross_of(two) * (w0 * w2 * dot_of(two) * (n - 1) - w1 * w1 * square * n) * 3;
  const DoubleDouble form = first - second;
  // the same with all terms positive
  const double l = reach(one), most0 = std::abs(w0.hi), most1 = std::abs(w1.hi);
  const double terms =
      (n - 2) * most0 * most1 * std::abs(w3.hi) * l * l * l * reach(three) +
      3.0 * std::abs(w2.hi) * l * reach(two) *
          ((n - 1) * most0 * std::abs(w2.hi) * l * reach(two) + n * most1 * most1 * l * l);
  constexpr double kOperations = 32.0;
  const double quad = most1 * most1 * most1 * most1, cube = square.hi * square.hi * square.hi;
  const double factor = (n - 1.0) * most0 / (static_cast<double>(n) * n * quad * cube);
  constexpr double kOfSlope = 32.0;
  end.slope = scale * scale * (factor * form.hi);
  end.slope_error = kOfSlope * kUnitRoundoff * std::abs(end.slope) +
                    scale * scale * (factor * kOperations * kDoubleDoubleRoundoff * terms);
}

/// kappa = (n-1)/n (w0 w2 / w1^2) cross(leg1, leg2) / |leg1|^3 from the three control points at one
/// end, legs from that end on, seen at the size of the first leg: nothing leaves the range of
/// doubles, whatever the size of the piece and its weights.
EndData bezier_end(const RationalBezier& piece, bool at_start, bool slopes) {
  const auto n = static_cast<std::size_t>(piece.degree);
  const auto at = [&](std::size_t j) { return at_start ? j : n - j; };
  const Vec2 first_leg = piece.offset[at(1)] - piece.offset[at(0)];
  const auto scale = unit_scale(largest_coordinate(first_leg));
  EndData end;
  place(end, piece.origin, piece.offset[at(0)]);
  end.point_rounding = kStored * largest_coordinate(end.point);
  end.heading_error = kOfDifference * kUnitRoundoff;
  if (!scale) {
    end.kappa = end.heading_error = std::numeric_limits<double>::quiet_NaN();
    return end;
  }
  const Leg one = leg_of(piece, at(0), at(1), *scale);
  const double side = at_start ? 1.0 : -1.0;
  end.direction = {side * one.x.hi, side * one.y.hi};
  const double length = norm(end.direction), cube = length * length * length;
  double coordinate =
      std::max(largest_coordinate(piece.offset[at(0)]), largest_coordinate(piece.offset[at(1)]));
  if (n >= 2) coordinate = std::max(coordinate, largest_coordinate(piece.offset[at(2)]));
  const double moved = kStored * (*scale * coordinate) / length;  // of a control point, by leg 1
  end.heading_rounding = kStored + 2.0 * moved;
  if (n < 2) return end;
  const Leg two = leg_of(piece, at(0), at(2), *scale);
  const DoubleDouble left = one.x * two.y, right = one.y * two.x;
  DoubleDouble area = left - right;
  const double w1 = piece.weight[at(1)];
  const double factor =
      (piece.degree - 1.0) / piece.degree * (piece.weight[at(0)] / w1) * (piece.weight[at(2)] / w1);
  constexpr double kOfArea = 3.0 * kDoubleDoubleRoundoff;  // two products and a difference
  double area_error = kOfArea * (std::abs(left.hi) + std::abs(right.hi));
  // three points of a line have no curvature, and nothing that a gap could be measured by
  if (std::abs(area.hi) <= area_error && collinear_exactly(piece, at(0), at(1), at(2))) {
    area = {};
    area_error = 0.0;
  }
  const double per_area = *scale * (factor / cube);
  end.kappa = side * per_area * area.hi;
  end.kappa_error =
      kOfCurvature * kUnitRoundoff * std::abs(end.kappa) + std::abs(per_area) * area_error;
  const double reach =
      1.0 + std::hypot(two.x.hi, two.y.hi) / length;  // turning leg 1 sweeps point 2
  end.kappa_rounding = std::abs(end.kappa) * 4.0 * (kStored + moved) +
                       *scale * std::abs(factor) * 2.0 * reach * (moved + kStored) / length;
  if (slopes) add_slope(end, piece, at_start, *scale, one, two);
  return end;
}

PieceEnds ends_of(const RationalBezier& piece, bool slopes) {
  return {bezier_end(piece, true, slopes), bezier_end(piece, false, slopes)};
}

}  // namespace

PieceEnds ends_of(const Piece& piece, bool slopes) {
  if (const auto* bezier = std::get_if<RationalBezier>(&piece)) return ends_of(*bezier, slopes);
  return std::visit(
      [](const auto& kind) -> PieceEnds {
        if constexpr (std::is_same_v<std::decay_t<decltype(kind)>, RationalBezier>)
          return {};
        else
          return ends_of(kind);
      },
      piece);
}

}  // namespace obvid
