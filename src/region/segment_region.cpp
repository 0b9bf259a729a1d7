// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/segment_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/region/internal/arcs_over_chord.h"
#include "two_arcs.h"

namespace obvid {
namespace {

using region_detail::Turning;

constexpr double kUnitRoundoff = 0x1p-53;
/// Rounding of A and B relative to the terms that cancel in them.
constexpr double kCancellation = 16.0 * kUnitRoundoff;

Vec2 rotated_back(Vec2 v, Vec2 u) { return {dot(u, v), cross(u, v)}; }

/// (1 - cos)/kappa for a unit tangent, 0 on a straight arc; without cancellation.
double rise_to_parallel(Vec2 tangent, double kappa) {
  if (kappa == 0.0 || std::isinf(kappa)) return 0.0;
  if (tangent.x <= 0.0) return (1.0 - tangent.x) / kappa;
  return tangent.y * tangent.y / ((1.0 + tangent.x) * kappa);
}

/// Whether an arc of curvature `kappa` that turns the tangent from a to b becomes parallel to the
/// chord on the way: along it, or against it.
struct Parallels {
  bool along = false, against = false;
};

Parallels parallels_of(Vec2 a, Vec2 b, double kappa, Turning turning) {
  // for arcs to the left; the others are mirror images
  const double side = kappa < 0.0 ? -1.0 : 1.0;
  const bool below = side * a.y < 0.0, then_below = side * b.y < 0.0;
  const bool over_half = turning == Turning::kOverHalf;
  if (below == then_below) return {over_half, over_half};
  if (turning == Turning::kBack) return {a.x + b.x > 0.0, a.x + b.x < 0.0};
  return {below, then_below};
}

/// Ordinate that an arc rises by until it runs against the chord.
double rise_to_opposite(Vec2 tangent, double kappa) {
  if (kappa == 0.0 || std::isinf(kappa)) return 0.0;
  if (tangent.x >= 0.0) return (1.0 + tangent.x) / kappa;
  return tangent.y * tangent.y / ((1.0 - tangent.x) * kappa);
}

Boundary make_boundary(const ChordFrame& f, double k0, double k1) {
  Boundary b{k0, k1, joint_tangent(f, k0, k1), 0.0, 0.0};
  const auto reach = [&b](double y) {
    b.highest = std::max(b.highest, y);
    b.lowest = std::min(b.lowest, y);
  };
  const auto [one, other] =
      region_detail::turnings(f.start_tangent, b.joint_tangent, f.end_tangent, k0, k1);
  if (!std::isinf(k0)) {
    const Parallels first = parallels_of(f.start_tangent, b.joint_tangent, k0, one);
    if (first.along) reach(-rise_to_parallel(f.start_tangent, k0));
    if (first.against) reach(rise_to_opposite(f.start_tangent, k0));
  }
  if (!std::isinf(k1)) {
    const Parallels second = parallels_of(b.joint_tangent, f.end_tangent, k1, other);
    if (second.along) reach(-rise_to_parallel(f.end_tangent, k1));
    if (second.against) reach(rise_to_opposite(f.end_tangent, k1));
  }
  return b;
}

/// A boundary as a function y(x) over the chord, with its slope's sine; arcs within a right angle.
struct Graph {
  double h, x_joint, k0, k1;
  Vec2 t0, t1;  ///< tangents at the start and at the end

  static std::optional<Graph> of(const ChordFrame& f, const Boundary& b) {
    if (std::isinf(b.kappa_first) || std::isinf(b.kappa_second)) return std::nullopt;
    const double least = std::min({f.start_tangent.x, f.end_tangent.x, b.joint_tangent.x});
    if (!(least > 0.0)) return std::nullopt;
    Graph g{f.h, 0.0, b.kappa_first, b.kappa_second, f.start_tangent, f.end_tangent};
    g.x_joint = joint_abscissa(f, g.k0, g.k1, b.joint_tangent);
    return g;
  }

  /// y of an arc through (0, 0) with tangent t and curvature k, at distance x. Cosines are never
  /// made of sines, which beside a right angle have lost them.
  static double arc(Vec2 t, double k, double x) {
    const double more = k * x;  // of the sine
    const double then = std::sqrt(std::max(0.0, t.x * t.x - more * (2.0 * t.y + more)));
    return x * (2.0 * t.y + more) / (t.x + then);
  }
  [[nodiscard]] double y(double x) const {
    return x <= x_joint ? arc(t0, k0, x) : -arc(t1, -k1, h - x);
  }
};

/// Largest gap |y_a - y_b| over the chord: at a joint, or where both arcs are equally steep.
double largest_gap(const Graph& a, const Graph& b) {
  double gap = 0.0;
  const auto look = [&](double x, double from, double to) {
    if (x > from && x < to) gap = std::max(gap, std::abs(a.y(x) - b.y(x)));
  };
  look(a.x_joint, 0.0, a.h);
  look(b.x_joint, 0.0, a.h);
  // heading sines are s0 + k0 x on first arcs and s1 - k1 (h - x) on second ones
  const double a1 = a.t1.y - a.k1 * a.h, b1 = b.t1.y - b.k1 * b.h;
  const double near = std::min(a.x_joint, b.x_joint), far = std::max(a.x_joint, b.x_joint);
  const auto equally_steep = [&](double sa, double ka, double sb, double kb, double from,
                                 double to) {
    if (ka != kb) look((sb - sa) / (ka - kb), from, to);
  };
  equally_steep(a.t0.y, a.k0, b.t0.y, b.k0, 0.0, near);
  if (a.x_joint < b.x_joint) equally_steep(a1, a.k1, b.t0.y, b.k0, near, far);
  if (b.x_joint < a.x_joint) equally_steep(a.t0.y, a.k0, b1, b.k1, near, far);
  equally_steep(a1, a.k1, b1, b.k1, far, a.h);
  return gap;
}

}  // namespace

ChordFrame chord_frame(Vec2 start, Vec2 start_tangent, double kappa_start, Vec2 end,
                       Vec2 end_tangent, double kappa_end) {
  const Vec2 chord = end - start;
  const double h = norm(chord);
  const Vec2 u = chord / h;
  return {h, rotated_back(start_tangent / norm(start_tangent), u),
          rotated_back(end_tangent / norm(end_tangent), u), kappa_start, kappa_end};
}

ChordFrame chord_frame(const Element& start, const Element& end) {
  return chord_frame(start.point, unit_at(start.theta), start.kappa, end.point, unit_at(end.theta),
                     end.kappa);
}

std::optional<SegmentRegion> segment_region(const ChordFrame& f, int direction) {
  const double d = direction;
  const double half_sine_squared = half_turn_sine_squared(f);
  const double a = d * 0.5 * f.kappa_start * f.h, b = d * 0.5 * f.kappa_end * f.h;
  const double sa = d * f.start_tangent.y, sb = d * f.end_tangent.y;
  const double noise_a = kCancellation * (std::abs(a) + std::abs(sa));
  const double noise_b = kCancellation * (std::abs(b) + std::abs(sb));
  const double half_sine = std::max(0.0, std::sqrt(half_sine_squared) - kCancellation);
  const double room_a = -(a + sa) + noise_a, room_b = (b - sb) + noise_b;
  // existence ([Kurnosenko 2013]): A < 0 < B and -A B > sin^2(sigma/2), each within its own
  // rounding
  if (!(room_a >= 0.0 && room_b >= 0.0 && room_a * room_b >= half_sine * half_sine)) {
    return std::nullopt;
  }
  const double A = std::min(a + sa, -noise_a), B = std::max(b - sb, noise_b);
  const double to = 2.0 * d / f.h;
  const double end_of_first = A == 0.0 ? f.kappa_end : to * (sb + half_sine_squared / -A);
  const double start_of_second = B == 0.0 ? f.kappa_start : to * (-sa - half_sine_squared / B);

  SegmentRegion r;
  r.from_start = make_boundary(f, f.kappa_start, end_of_first);
  r.to_end = make_boundary(f, start_of_second, f.kappa_end);
  const double high = std::abs(r.from_start.highest - r.to_end.highest);
  const double low = std::abs(r.from_start.lowest - r.to_end.lowest);
  r.parallel_width = std::max(high, low);
  const bool above =
      r.from_start.highest + r.to_end.highest >= -r.from_start.lowest - r.to_end.lowest;
  r.lower_height = above ? std::min(r.from_start.highest, r.to_end.highest)
                         : std::min(-r.from_start.lowest, -r.to_end.lowest);
  r.width = r.parallel_width;
  const auto g0 = Graph::of(f, r.from_start), g1 = Graph::of(f, r.to_end);
  if (g0 && g1) r.width = std::max(r.width, largest_gap(*g0, *g1));
  return r;
}

double bilens_width(const ChordFrame& f) {
  const auto half_tangent = [](Vec2 t) {
    return t.y / (1.0 + std::max(t.x, -1.0 + kCancellation));
  };
  return 0.5 * f.h * std::abs(half_tangent(f.start_tangent) + half_tangent(f.end_tangent));
}

std::optional<double> boundary_ordinate(const ChordFrame& frame, const Boundary& boundary,
                                        double x) {
  const auto graph = Graph::of(frame, boundary);
  if (!graph) return std::nullopt;
  return graph->y(x);
}

bool contains(const SegmentRegion& region, const ChordFrame& f, Vec2 p, double slack) {
  const double top = std::max(region.from_start.highest, region.to_end.highest);
  const double bottom = std::min(region.from_start.lowest, region.to_end.lowest);
  if (p.y > top + slack || p.y < bottom - slack) return false;
  const auto g0 = Graph::of(f, region.from_start), g1 = Graph::of(f, region.to_end);
  if (!g0 || !g1) return true;
  if (p.x < -slack || p.x > f.h + slack) return false;
  const double x = std::clamp(p.x, 0.0, f.h);
  const double y0 = g0->y(x), y1 = g1->y(x);
  return p.y >= std::min(y0, y1) - slack && p.y <= std::max(y0, y1) + slack;
}

}  // namespace obvid
