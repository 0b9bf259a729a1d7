// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/arcs.h"

#include <algorithm>
#include <cmath>

#include "obvid/region/internal/arcs_over_chord.h"

namespace obvid {
namespace {

/// Range of the first arc's curvature between the two boundaries of the region.
BiarcCurvatures middle_biarc(const ChordFrame& f, const SegmentRegion& r) {
  const double sa = f.start_tangent.y, half = 0.5 * f.h;
  const double from = half * r.from_start.kappa_first + sa;
  const double to = half * r.to_end.kappa_first + sa;
  const double middle = std::copysign(std::sqrt(std::max(0.0, from * to)), from);
  const double first = (middle - sa) / half;
  return {first, second_curvature(f, first)};
}

/// How far an arc turns, with the tangent of half of it.
struct ArcTurn {
  double angle, half_tangent;
};

ArcTurn arc_turn(Vec2 from, Vec2 to) {
  const double half_tangent = cross(from, to) / (1.0 + dot(from, to));
  return {2.0 * std::atan(half_tangent), half_tangent};
}

/// First curvature of the biarc through p: p lies on its first arc, or on its second.
double first_through(const ChordFrame& f, Vec2 p) {
  const double on_first = 2.0 * cross(f.start_tangent, p) / dot(p, p);
  const double then = second_curvature(f, on_first);
  if (p.x <= joint_abscissa(f, on_first, then, joint_tangent(f, on_first, then))) return on_first;
  const Vec2 rest = Vec2{f.h, 0.0} - p;
  const double second = 2.0 * cross(rest, f.end_tangent) / dot(rest, rest);
  const double B = 0.5 * second * f.h - f.end_tangent.y;
  return 2.0 / f.h * (-f.start_tangent.y - half_turn_sine_squared(f) / B);
}

/// The second turn of a biarc: what the first one leaves of the whole, where that loses no digits
/// (an arctangent saved), else from its own tangents. Headings may be a full turn apart.
ArcTurn remaining_turn(Vec2 from, Vec2 to, double whole, double first) {
  constexpr double kTurnsWell = 0.05;  // tangent of half the turn
  constexpr double kFewTurns = 64.0;   // rad: the whole keeps 14 digits
  constexpr double kSameBranch = 1.0;  // rad: far below a full turn, far above 2 x - 2 arctan x
  const double x = cross(from, to) / (1.0 + dot(from, to));
  const double rest = whole - first;
  const bool good = std::abs(x) > kTurnsWell && std::abs(whole) < kFewTurns &&
                    std::abs(rest - 2.0 * x) < kSameBranch;
  return {good ? rest : 2.0 * std::atan(x), x};
}

/// Length of an arc. An arc that hardly turns has it from its chord: its angle, a difference of
/// headings, has lost too many digits. With x the tangent of half the turn, half / sin(half) is
/// 1 + x^2/6 - 11 x^4/120 to rounding.
double arc_length_of(Vec2 chord, double kappa, ArcTurn turn) {
  constexpr double kHardlyTurns = 1e-3;  // x^6 is below rounding
  const double x = turn.half_tangent;
  if (std::abs(x) > kHardlyTurns) return turn.angle / kappa;
  return norm(chord) * (1.0 + x * x * (1.0 / 6.0 - 11.0 / 120.0 * x * x));
}

}  // namespace

double second_curvature(const ChordFrame& f, double first) {
  const double q = half_turn_sine_squared(f);
  const double A = 0.5 * first * f.h + f.start_tangent.y;
  return 2.0 / f.h * (f.end_tangent.y - q / A);
}

std::optional<BiarcCurvatures> choose_biarc(const ChordFrame& f, int direction) {
  const auto region = segment_region(f, direction);
  if (!region) return std::nullopt;
  if (!(f.start_tangent.y * f.end_tangent.y < 0.0)) return middle_biarc(f, *region);
  const double apex_x = f.h * f.end_tangent.y * f.start_tangent.x /
                        (f.end_tangent.y * f.start_tangent.x - f.start_tangent.y * f.end_tangent.x);
  const Vec2 apex = {apex_x, apex_x * f.start_tangent.y / f.start_tangent.x};
  const auto one = part_of_median(f, region->from_start, apex);
  const auto other = part_of_median(f, region->to_end, apex);
  if (!one || !other) return middle_biarc(f, *region);
  const Vec2 foot = {0.5 * f.h, 0.0};
  const double first = first_through(f, foot + 0.5 * (*one + *other) * (apex - foot));
  const double low = std::min(region->from_start.kappa_first, region->to_end.kappa_first);
  const double high = std::max(region->from_start.kappa_first, region->to_end.kappa_first);
  // in a region narrower than rounding the median point says nothing
  if (!(first > low && first < high)) return middle_biarc(f, *region);
  return BiarcCurvatures{first, second_curvature(f, first)};
}

std::array<Piece, 2> biarc(const Element& start, const Element& end, const BiarcCurvatures& k) {
  const Vec2 chord = end.point - start.point;
  const double h = norm(chord);
  const double a = 0.5 * k.first * h, b = 0.5 * k.second * h;
  const Vec2 t0 = unit_at(start.theta), t1 = unit_at(end.theta);
  // closing the chord: (b - a) e^{i theta} = 2 i a b u + b t0 - a t1, u along the chord
  const Vec2 v = (2.0 * a * b / h) * left_normal(chord) + b * t0 - a * t1;
  const double length = norm(v);
  // the rounding of both headings moves the joint by u / |b - a| of the chord: where that is a part
  // of the chord that can be seen, the arcs are one circle, and meet half way
  constexpr double kOneCircle = 64.0 * 0x1p-53;
  const bool one_circle = std::abs(b - a) <= kOneCircle || !(length > 0.0);
  const Vec2 middle = t0 + t1;
  const Vec2 tangent = one_circle ? middle / norm(middle) : v / std::copysign(length, b - a);
  const ArcTurn first = arc_turn(t0, tangent);
  const ArcTurn second = remaining_turn(tangent, t1, end.theta - start.theta, first.angle);
  // the joint from the arc that bends more: its turning is known best
  const Vec2 joint =
      one_circle ? start.point + 0.5 * (chord - first.half_tangent * left_normal(chord))
      : std::abs(a) >= std::abs(b) ? start.point + (first.half_tangent / k.first) * (t0 + tangent)
                                   : end.point - (second.half_tangent / k.second) * (tangent + t1);
  const auto piece = [](Vec2 from, Vec2 to, double theta, double kappa, ArcTurn turn) -> Piece {
    if (kappa == 0.0) return LinePiece{from, to};
    return ArcPiece{from, to, theta, kappa, arc_length_of(to - from, kappa, turn)};
  };
  return {piece(start.point, joint, start.theta, k.first, first),
          piece(joint, end.point, start.theta + first.angle, k.second, second)};
}

}  // namespace obvid
