// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/boundary_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/golden.h"
#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::Arc;
using region_detail::TwoArcs;

class Placement {
 public:
  Placement(const Piece& piece, const ChordFrame& frame, const SegmentRegion& region, Vec2 origin,
            Vec2 along)
      : piece_(piece),
        frame_(frame),
        region_(region),
        origin_(origin),
        along_(along),
        from_start_(frame, region.from_start),
        to_end_(frame, region.to_end) {}

  [[nodiscard]] Vec2 at(double t) const { return evaluate(piece_, t).point; }
  [[nodiscard]] double farther(double t) const {
    const Vec2 p = local(t);
    return std::max(from_start_.distance(p), to_end_.distance(p));
  }
  [[nodiscard]] double outside(double t) const {
    const Vec2 p = local(t);
    const double x = std::clamp(p.x, 0.0, frame_.h);
    const auto y0 = ordinate_over_chord(frame_, region_.from_start, x);
    const auto y1 = ordinate_over_chord(frame_, region_.to_end, x);
    const bool in_chord = p.x >= 0.0 && p.x <= frame_.h;
    if (!y0 || !y1) return 0.0;
    if (in_chord && p.y >= std::min(*y0, *y1) && p.y <= std::max(*y0, *y1)) return 0.0;
    return std::min(from_start_.distance(p), to_end_.distance(p));
  }

 private:
  [[nodiscard]] Vec2 local(double t) const {
    const Vec2 v = at(t) - origin_;
    return {dot(along_, v), cross(along_, v)};
  }
  const Piece& piece_;
  const ChordFrame& frame_;
  const SegmentRegion& region_;
  Vec2 origin_, along_;
  TwoArcs from_start_, to_end_;
};

/// The place between two others where f is largest, which rises to it and falls from it.
template <class F>
double peak_between(const F& f, double low, double high) {
  constexpr double kTopFoundTo = 3e-11;  // of a step; the value is flat there
  return highest_place(low, high, f, kTopFoundTo * (high - low));
}

/// Where f, 0 at all places that were looked at, is largest nearer than `step` to the ends of
/// [0, 1].
template <class F>
double largest_beside_ends(const F& f, double step) {
  constexpr int kHalvings = 40;
  double best = 0.0, most = 0.0;
  for (int n = 1; n <= kHalvings; ++n) {
    const double t = std::ldexp(step, -n);
    for (const bool back : {false, true}) {
      const double at = back ? 1.0 - t : t;
      if (!(f(at) > most)) continue;
      best =
          back ? peak_between(f, 1.0 - 2.0 * t, 1.0 - 0.5 * t) : peak_between(f, 0.5 * t, 2.0 * t);
      most = f(best);
    }
  }
  return best;
}

/// Largest value of f on [0, 1]: some places, closer together towards both ends, where curves leave
/// a region and return at once, then thirds around each that is higher than its neighbours and
/// nearly as high as the highest.
template <class F>
double largest_at(const F& f, int samples) {
  constexpr double kNearlyAsHigh = 0.9;
  const auto place = [samples](int i) {
    const double half = std::sin(0.5 * std::numbers::pi * i / samples);
    return half * half;
  };
  std::vector<double> value;
  for (int i = 0; i <= samples; ++i) value.push_back(f(place(i)));
  const auto highest = std::max_element(value.begin(), value.end());
  if (*highest == 0.0) return largest_beside_ends(f, place(1));
  const double high_enough = kNearlyAsHigh * *highest;
  double most = *highest, best = place(static_cast<int>(highest - value.begin()));
  for (int i = 0; i <= samples; ++i) {
    const auto at = [&](int k) { return value[static_cast<std::size_t>(k)]; };
    const int before = std::max(0, i - 1), after = std::min(samples, i + 1);
    if (!(at(i) >= high_enough && at(i) >= at(before) && at(i) >= at(after))) continue;
    const double t = peak_between(f, place(before), place(after));
    if (f(t) < most) continue;
    most = f(t);
    best = t;
  }
  return best;
}

}  // namespace

double boundary_distance(const ChordFrame& frame, const Boundary& boundary, Vec2 local) {
  return TwoArcs(frame, boundary).distance(local);
}

std::vector<Piece> boundary_arcs(const ChordFrame& f, const Boundary& b) {
  std::vector<Piece> out;
  const auto add = [&](Vec2 from, Vec2 to, Vec2 tangent, double turn, double kappa) {
    if (norm(to - from) == 0.0) return;
    if (turn * kappa > 0.0) {
      out.emplace_back(ArcPiece{from, to, heading(tangent), kappa, turn / kappa});
    } else {  // straight, or turned back by rounding
      out.emplace_back(LinePiece{from, to});
    }
  };
  const Vec2 end{f.h, 0.0};
  // beside a circle of radius 0 one arc spans the chord, alike at both ends
  if (std::isinf(b.kappa_first)) {
    const Vec2 start{f.end_tangent.x, -f.end_tangent.y};
    add({}, end, start, 2.0 * heading(f.end_tangent), b.kappa_second);
    return out;
  }
  if (std::isinf(b.kappa_second)) {
    add({}, end, f.start_tangent, -2.0 * heading(f.start_tangent), b.kappa_first);
    return out;
  }
  const TwoArcs arcs(f, b);
  for (const Arc* arc : {&arcs.first, &arcs.second}) {
    const double turn = turning(arc->start_tangent, arc->end_tangent);
    const double whole =
        arc->over_half && turn * arc->kappa < 0.0 ? std::copysign(kFullTurn, arc->kappa) : 0.0;
    add(arc->start, arc->end, arc->start_tangent, turn + whole, arc->kappa);
  }
  return out;
}

std::optional<double> ordinate_over_chord(const ChordFrame& frame, const Boundary& b, double x) {
  if (!std::isinf(b.kappa_first) && !std::isinf(b.kappa_second)) {
    return boundary_ordinate(frame, b, x);
  }
  const bool second_alone = std::isinf(b.kappa_first);
  const double kappa = second_alone ? b.kappa_second : b.kappa_first;
  ChordFrame circle = frame;
  if (second_alone) circle.start_tangent = {frame.end_tangent.x, -frame.end_tangent.y};
  if (!second_alone) circle.end_tangent = {frame.start_tangent.x, -frame.start_tangent.y};
  return boundary_ordinate(circle, {kappa, kappa, circle.end_tangent, 0.0, 0.0}, x);
}

std::optional<RegionPlacement> place_in_region(const Piece& piece, const Element& start,
                                               const Element& end, int direction, int samples) {
  const ChordFrame frame = chord_frame(start, end);
  const auto region = segment_region(frame, direction);
  if (!region) return std::nullopt;
  const Vec2 along = (end.point - start.point) / frame.h;
  const Placement place(piece, frame, *region, start.point, along);
  const double t0 = largest_at([&](double t) { return place.farther(t); }, samples);
  const double t1 = largest_at([&](double t) { return place.outside(t); }, samples);
  return RegionPlacement{place.farther(t0), place.outside(t1), place.at(t0), place.at(t1)};
}

std::optional<ConvexErrors> convex_errors(const Element& start, const Element& end, int direction,
                                          const ConvexTriangle& triangle) {
  const ChordFrame frame = chord_frame(start, end);
  const auto region = segment_region(frame, direction);
  if (!region) return std::nullopt;
  const auto height = [&](const Boundary& b) { return triangle.side > 0 ? b.highest : -b.lowest; };
  const bool start_is_lower = height(region->from_start) <= height(region->to_end);
  const Boundary& lower = start_is_lower ? region->from_start : region->to_end;
  const Boundary& upper = start_is_lower ? region->to_end : region->from_start;
  const Vec2 along = (end.point - start.point) / frame.h, v = triangle.apex - start.point;
  ConvexErrors e;
  e.upper_height = height(upper);
  e.lower_height = height(lower);
  e.apex_height = triangle.height;
  e.apex_gap = triangle.height - e.lower_height;
  e.apex_distance = boundary_distance(frame, lower, {dot(along, v), cross(along, v)});
  e.bound = std::max(e.upper_height, e.apex_distance);
  return e;
}

}  // namespace obvid
