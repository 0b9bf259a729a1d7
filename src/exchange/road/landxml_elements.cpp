// SPDX-License-Identifier: Apache-2.0
#include "road/landxml_elements.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "obvid/alignment/internal/transition_law.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/internal/angle.h"

namespace obvid::exchange {
namespace {

// Radius and centre that differ by more, as part of the radius, are contradictory, not rounded.
constexpr double kSameRadius = 1e-3;

// Arcs that turn by less (rad) are placed by their ends, which say where the neighbours are; from
// here on the arc sine loses digits, and the centre decides.
constexpr double kPlacedByEnds = 1.0;

// A chord shorter than this part of the length says nothing about the heading.
constexpr double kShortChord = 1e-3;

// Lines of this heading against the PI (rad) are doubtful: five minutes of arc.
constexpr double kAlongTangent = 1.5e-3;

/// Turning of an arc in its sense of rotation, (0, 2 pi].
double turn_of(const StatedCurve& curve, double radius) {
  const double chord = norm(curve.end - curve.start);
  const double reach = std::min(1.0, 0.5 * chord / radius);
  const double small = 2.0 * std::asin(reach);
  if (!curve.centre) return small;
  const Vec2 from = curve.start - *curve.centre, to = curve.end - *curve.centre;
  double turn = turning(from, to) * (curve.left ? 1.0 : -1.0);
  if (turn <= 0.0) turn += kFullTurn;
  return turn < kPlacedByEnds ? small : turn;
}

/// Whether a piece that turns by `turn` ends where and as the next one of its kind begins.
template <class Curved>
bool goes_on_smoothly(const Curved& a, double turn, const Curved& b) {
  constexpr double kApart = 1e-9;   // of both lengths
  constexpr double kGoesOn = 1e-6;  // rad
  return norm(a.end - b.start) <= kApart * (a.length + b.length) &&
         std::abs(turn_between(b.theta0, a.theta0 + turn)) <= kGoesOn;
}

}  // namespace

std::optional<PlacedPiece> placed(const StatedCurve& curve, std::string& why) {
  const double measured =
      curve.centre ? 0.5 * (norm(curve.start - *curve.centre) + norm(curve.end - *curve.centre))
                   : 0.0;
  if (curve.radius && !(*curve.radius > 0.0)) {
    why = "a Curve whose radius is not greater than 0";
    return std::nullopt;
  }
  if (!curve.radius && !(measured > 0.0)) {
    why = "a Curve without radius and centre";
    return std::nullopt;
  }
  if (!curve.centre && 0.5 * norm(curve.end - curve.start) > *curve.radius) {
    why = "a Curve whose radius does not reach from start to end";
    return std::nullopt;
  }
  PlacedPiece out;
  double radius = curve.radius.value_or(measured);
  if (curve.centre && std::abs(radius - measured) > kSameRadius * radius) {
    out.doubt = "the radius of a Curve contradicts its centre, which is used";
    radius = measured;
  }
  const double side = curve.left ? 1.0 : -1.0, turn = turn_of(curve, radius);
  ArcPiece arc;
  arc.start = curve.start;
  arc.end = curve.end;
  arc.kappa = side / radius;
  arc.length = radius * turn;
  arc.theta0 = turn < kPlacedByEnds || !curve.centre
                   ? heading(curve.end - curve.start) - 0.5 * side * turn
                   : heading(side * left_normal(curve.start - *curve.centre));
  const Vec2 end = arc.start + clothoid_step(arc.theta0, arc.kappa, arc.kappa, arc.length);
  if (!(arc.length > 0.0) || !is_finite(end)) {
    why = "a Curve that comes to no point";
    return std::nullopt;
  }
  out.off_end = norm(end - arc.end);
  out.piece = arc;
  return out;
}

std::optional<PlacedPiece> placed(const StatedSpiral& spiral, std::string& why) {
  const double side = spiral.left ? 1.0 : -1.0;
  ClothoidPiece c;
  c.start = spiral.start;
  c.end = spiral.end;
  c.kappa0 = side * spiral.kappa0;
  c.kappa1 = side * spiral.kappa1;
  c.length = spiral.length;
  if (!(c.length > 0.0)) {
    why = "a Spiral whose length is not greater than 0";
    return std::nullopt;
  }
  if (!TransitionLaw(spiral.law, c.kappa0, c.kappa1, c.length).exists()) {
    why = "a Spiral of a type that does not turn so far between its radii";
    return std::nullopt;
  }
  if (turns_too_far(c.kappa0, c.kappa1, c.length)) {
    why = "a Spiral of more than a hundred turns";
    return std::nullopt;
  }
  const auto step = [&](double theta) {
    return spiral.law == Transition::kClothoid
               ? clothoid_step(theta, c.kappa0, c.kappa1, c.length)
               : transition_at(spiral.law, {{}, theta, c.kappa0}, c.kappa1, c.length, c.length)
                     .point;
  };
  const Vec2 chord = c.end - c.start, own = step(0.0);
  const bool by_chord = std::min(norm(chord), norm(own)) > kShortChord * c.length;
  if (!by_chord && !spiral.meeting) {
    why = "a Spiral whose start and end do not say its heading";
    return std::nullopt;
  }
  PlacedPiece out;
  const double along = by_chord ? heading(complex_product(chord, {own.x, -own.y})) : 0.0;
  const double to_meeting = spiral.meeting ? heading(*spiral.meeting - c.start) : along;
  c.theta0 = by_chord ? along : to_meeting;
  if (std::abs(turn_between(to_meeting, c.theta0)) > kAlongTangent) {
    out.doubt = "the PI of a Spiral contradicts its start, end, length and radii; it is not used";
  }
  const Vec2 end = c.start + step(c.theta0);
  if (!is_finite(end)) {
    why = "a Spiral that comes to no point";
    return std::nullopt;
  }
  out.off_end = norm(end - c.end);
  out.piece = c;
  if (c.kappa0 == c.kappa1) {
    out.piece = c.kappa0 == 0.0 ? Piece(LinePiece{c.start, c.end})
                                : Piece(ArcPiece{c.start, c.end, c.theta0, c.kappa0, c.length});
  }
  return out;
}

std::optional<Piece> joined(const Piece& first, const Piece& second) {
  constexpr double kSame = 1e-9;  // of the larger: what the digits of a file leave
  const auto same = [](double a, double b) {
    return std::abs(a - b) <= kSame * std::max(std::abs(a), std::abs(b));
  };
  if (const auto* a = std::get_if<ArcPiece>(&first)) {
    const auto* b = std::get_if<ArcPiece>(&second);
    if (b == nullptr || !same(a->kappa, b->kappa)) return std::nullopt;
    if (!goes_on_smoothly(*a, a->kappa * a->length, *b)) return std::nullopt;
    const double length = a->length + b->length;
    if (std::abs(a->kappa) * length >= 0.5 * kFullTurn) return std::nullopt;
    return ArcPiece{a->start, b->end, a->theta0, a->kappa, length};
  }
  const auto* a = std::get_if<ClothoidPiece>(&first);
  const auto* b = std::get_if<ClothoidPiece>(&second);
  if (a == nullptr || b == nullptr) return std::nullopt;
  const double rate = (a->kappa1 - a->kappa0) / a->length;
  const bool goes_on = a->kappa1 == b->kappa0 || same(a->kappa1, b->kappa0);
  if (!goes_on || !same(rate, (b->kappa1 - b->kappa0) / b->length)) return std::nullopt;
  if (!goes_on_smoothly(*a, 0.5 * (a->kappa0 + a->kappa1) * a->length, *b)) return std::nullopt;
  return ClothoidPiece{a->start, b->end, a->theta0, a->kappa0, b->kappa1, a->length + b->length};
}

bool closed_up(std::vector<Piece>& pieces) {
  constexpr double kMeeting = 1e-9;  // of the length
  double length = 0.0;
  for (const Piece& piece : pieces) length += norm(end_point(piece) - start_point(piece));
  const Vec2 start = start_point(pieces.front());
  if (!(norm(end_point(pieces.back()) - start) <= kMeeting * length)) return false;
  std::visit(
      [&](auto& last) {
        if constexpr (requires { last.end = start; }) last.end = start;
      },
      pieces.back());
  return end_point(pieces.back()) == start;
}

}  // namespace obvid::exchange
