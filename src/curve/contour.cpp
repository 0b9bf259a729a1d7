// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/contour.h"
#include "obvid/geom/internal/angle.h"

#include <cmath>
#include <numbers>

namespace obvid {

bool is_corner(const Joint& joint) {
  if (!joint.leaving) return false;
  const double turn = joint.leaving->theta - joint.element.theta;
  return !(std::abs(principal_angle(turn)) <= kTangentTurn);
}

std::optional<Carrier> carrier_of(std::string_view name) {
  for (const CarrierInfo& info : kCarriers) {
    if (name == info.name) return info.carrier;
  }
  return std::nullopt;
}

const char* to_string(Continuity continuity) { return continuity == Continuity::kG3 ? "G3" : "G2"; }

std::optional<Continuity> continuity_of(std::string_view name) {
  if (name == "G2") return Continuity::kG2;
  if (name == "G3") return Continuity::kG3;
  return std::nullopt;
}

namespace {

/// Arcs of one circle have the same curvature but for this part, and no turn of so many rad between
/// them: what rounding leaves.
constexpr double kSameCircle = 1e-9;
/// Arcs of one ellipse, in parts of the longer one's chord: where rounding put a vertex inside an
/// arc, it was moved by up to 1e-8 of its size, and ten times as much where one follows it past its
/// end.
constexpr double kSameEllipse = 1e-7;

/// How far a point lies from the ellipse of an arc of degree 2, to first order, in chords of the
/// arc.
double off_conic(const RationalBezier& arc, Vec2 at) {
  const Vec2 a = arc.offset[1] - arc.offset[0], b = arc.offset[2] - arc.offset[0];
  const Vec2 way = at - arc.origin - arc.offset[0];
  const double area = cross(a, b);
  const double second = cross(way, b) / area, third = cross(a, way) / area;
  const double first = 1.0 - second - third;  // barycentric in the triangle of control points
  const double share = 4.0 * arc.weight[1] * arc.weight[1] / (arc.weight[0] * arc.weight[2]);
  const double off = second * second - share * first * third;
  // derivatives by x and y of the barycentric coordinates are the sides, turned and over the area
  const Vec2 by_second = Vec2{b.y, -b.x} / area, by_third = Vec2{-a.y, a.x} / area;
  const Vec2 by_first = -(by_second + by_third);
  const Vec2 slope = 2.0 * second * by_second - share * (third * by_first + first * by_third);
  return std::abs(off) / (norm(slope) * norm(b));
}

bool same_ellipse(const RationalBezier& one, const RationalBezier& other) {
  if (one.degree != 2 || other.degree != 2) return false;
  const bool first = norm(one.offset[2] - one.offset[0]) > norm(other.offset[2] - other.offset[0]);
  const RationalBezier &longer = first ? one : other, &shorter = first ? other : one;
  for (const double t : {0.0, 0.5, 1.0}) {
    if (!(off_conic(longer, evaluate(Piece{shorter}, t).point) <= kSameEllipse)) return false;
  }
  return true;
}

/// Whether piece `i` goes on with the arc or ellipse of the piece before it. A step of the
/// curvature that is there through rounding alone does not matter.
bool goes_on(const Contour& contour, std::size_t i) {
  const Piece &before = contour.pieces[i - 1], &piece = contour.pieces[i];
  const Joint* joint = i < contour.joints.size() ? &contour.joints[i] : nullptr;
  if (joint != nullptr && is_corner(*joint)) return false;
  const auto *one = std::get_if<RationalBezier>(&before),
             *next = std::get_if<RationalBezier>(&piece);
  if (one != nullptr && next != nullptr) return same_ellipse(*one, *next);
  const auto *a = std::get_if<ArcPiece>(&before), *b = std::get_if<ArcPiece>(&piece);
  if (a == nullptr || b == nullptr) return false;
  const double turn =
      joint != nullptr && joint->leaving ? joint->leaving->theta - joint->element.theta : 0.0;
  return std::abs(principal_angle(turn)) <= kSameCircle &&
         std::abs(a->kappa - b->kappa) <= kSameCircle * std::abs(b->kappa);
}

}  // namespace

KeptPieces kept_pieces(const Contour& contour) {
  KeptPieces out;
  std::size_t before = contour.pieces.size();
  for (const std::size_t i : contour.kept) {
    const bool more = before + 1 == i && goes_on(contour, i);
    before = i;
    if (more) continue;
    const Piece& piece = contour.pieces[i];
    if (std::holds_alternative<LinePiece>(piece)) ++out.lines;
    if (std::holds_alternative<ArcPiece>(piece)) ++out.arcs;
    if (std::holds_alternative<RationalBezier>(piece)) ++out.ellipses;
    if (std::holds_alternative<ClothoidPiece>(piece)) ++out.clothoids;
  }
  return out;
}

}  // namespace obvid
