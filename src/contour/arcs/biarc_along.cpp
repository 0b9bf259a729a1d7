// SPDX-License-Identifier: Apache-2.0
#include "biarc_along.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/geom/internal/circle.h"
#include "peak.h"

namespace obvid::arcs {
namespace {

constexpr double kMostPairTurn =
    2.4;                          // of the contour beside a pair, rad: arcs stay below half a turn
constexpr int kPairSamples = 24;  // of a pair, and at least two of each piece beside it

/// Arc from a point with this heading to another one. A line where it does not turn at all.
Piece arc_between(Vec2 from, double theta, Vec2 to) {
  const Vec2 chord = to - from;
  const double length = norm(chord);
  const double half = turning(unit_at(theta), chord);
  if (half == 0.0) return LinePiece{from, to};
  const double kappa = 2.0 * std::sin(half) / length;
  return ArcPiece{from, to, theta, kappa, length * half / std::sin(half)};
}

Circle circle_of(const Piece& piece) {
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    return {arc->start, unit_at(arc->theta0), arc->kappa};
  }
  const auto& line = std::get<LinePiece>(piece);
  const Vec2 along = line.end - line.start;
  return {line.start, along / norm(along), 0.0};
}

double distance(const Circle& c, Vec2 p) { return std::abs(signed_distance(c, p)); }

/// Where the arcs of a pair meet. Legs d and r d: |v - d (t0 + r t1)| = (1 + r) d.
Vec2 joint_of(const Node& a, const Node& b, Vec2 t0, Vec2 t1) {
  const Vec2 v = b.point - a.point, difference = t0 - t1;
  const double r = b.ratio, forward = dot(v, t0 + r * t1), square = dot(v, v);
  // (1 - cos) without cancellation
  const double leg =
      square / (forward + std::sqrt(forward * forward + r * dot(difference, difference) * square));
  const Vec2 before = a.point + leg * t0, behind = b.point - (r * leg) * t1;
  return (1.0 / (1.0 + r)) * (r * before + behind);
}

/// Curvature of the arc that leaves `from` along a unit vector and ends in `to`.
double arc_curvature(Vec2 from, Vec2 tangent, Vec2 to) {
  const Vec2 chord = to - from;
  return 2.0 * cross(tangent, chord) / dot(chord, chord);
}

bool goes_forward(const Piece& piece) {
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    return arc->length > 0.0 && std::isfinite(arc->length) && std::isfinite(arc->kappa);
  }
  const auto& line = std::get<LinePiece>(piece);
  return !(line.start == line.end);
}

}  // namespace

double signed_distance(const Circle& c, Vec2 p) {
  return distance_beside_circle(c.start, c.tangent, c.kappa, p);
}

CirclePair circles_between(const Node& a, const Node& b) {
  const Vec2 t0 = unit_at(a.theta), t1 = unit_at(b.theta);
  const Vec2 joint = joint_of(a, b, t0, t1);
  const Vec2 chord = joint - a.point;
  // the tangent there is that of the start, mirrored at the chord's bisector
  const Vec2 along = (2.0 * dot(t0, chord) / dot(chord, chord)) * chord - t0;
  return {{a.point, t0, arc_curvature(a.point, t0, joint)},
          {joint, along, arc_curvature(joint, along, b.point)}};
}

/// Two arcs whose tangents at both ends have lengths of this ratio (Bolton, "Biarc curves", 1975):
/// always there for headings less than half a turn apart.
std::array<Piece, 2> arcs_between(const Node& a, const Node& b) {
  const Vec2 t0 = unit_at(a.theta);
  const Vec2 middle = joint_of(a, b, t0, unit_at(b.theta));
  const double theta = a.theta + 2.0 * turning(t0, middle - a.point);
  return {arc_between(a.point, a.theta, middle), arc_between(middle, theta, b.point)};
}

std::optional<PairCurvatures> pair_along(const Track& track, const Node& a, const Node& b,
                                         double tolerance) {
  const auto pair = arcs_between(a, b);
  if (!goes_forward(pair[0]) || !goes_forward(pair[1])) return std::nullopt;
  const std::array<Circle, 2> circle = {circle_of(pair[0]), circle_of(pair[1])};
  const Track::Place first = track.place(a.s, false), last = track.place(b.s, true);
  const std::size_t pieces = last.piece - first.piece + 1;
  const int each =
      std::max(2, kPairSamples / static_cast<int>(std::min<std::size_t>(pieces, kPairSamples)));
  double before = 0.0, here = 0.0, turned = 0.0, deviation = 0.0;
  Vec2 heading_before = evaluate(track.piece(first.piece), first.t).d1;
  for (std::size_t i = first.piece; i <= last.piece; ++i) {
    const double s0 = std::max(a.s, track.start_of(i)), s1 = std::min(b.s, track.start_of(i + 1));
    for (int k = 1; k <= each; ++k) {
      const Jet jet = track.jet(s0 + (s1 - s0) * k / each, true);
      turned += std::abs(turning(heading_before, jet.d1));
      heading_before = jet.d1;
      const bool on_first = dot(jet.point - circle[1].start, circle[1].tangent) <= 0.0;
      const double next = distance(circle[on_first ? 0 : 1], jet.point);
      deviation = std::max({deviation, peak(before, here, next), next});
      if (!(deviation <= tolerance) || turned > kMostPairTurn) return std::nullopt;
      before = here;
      here = next;
    }
  }
  return PairCurvatures{circle[0].kappa, circle[1].kappa};
}

}  // namespace obvid::arcs
