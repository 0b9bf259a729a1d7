// SPDX-License-Identifier: Apache-2.0
#include "sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid::toolpath {
namespace {

constexpr double kSettledOnWay = 1e-6;  // of the radius
constexpr int kMostWaySteps = 60;       // a bracket of the way is halved at least every third step
constexpr int kMostRaySteps = 50;       // of Newton's method, from outside
constexpr double kInsideRim = 1.0 - 1e-9;  // of half a chord across the rim
constexpr double kSecantInside = 0.05;     // of the bracket: a secant keeps that far from its ends

/// Distance from the body at a place on the way, by the way and by the point.
struct AtPlace {
  double value = 0.0, slope = 0.0;
  Vec3 gradient;
};

AtPlace at_place(const CutterShape& cutter, const Sweep& sweep, Vec3 way, double s, Vec3 p) {
  const Vec3 from_tip = p - (sweep.from + s * way);
  const double level = std::sqrt(from_tip.x * from_tip.x + from_tip.y * from_tip.y);
  const BodyDistance d = cutter.distance(level, from_tip.z);
  AtPlace out;
  out.value = d.value;
  out.gradient = {0.0, 0.0, d.by_height};
  if (level > 0.0) {
    out.gradient.x = d.by_level * from_tip.x / level;
    out.gradient.y = d.by_level * from_tip.y / level;
  }
  out.slope = -dot(out.gradient, way);
  return out;
}

double part_of_way(double along, double length2) {
  return length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
}

/// Balls: the centre nearest in space where it stands over the point, the way nearest as seen from
/// above where it stands under it. Either is the least of a convex function; false: neither.
bool distance_from_ball(double radius, const Sweep& sweep, Vec3 p, SweepDistance& out) {
  const Vec3 way = sweep.to - sweep.from;
  const Vec3 to = p - sweep.from - Vec3{0.0, 0.0, radius};
  const Vec3 off = to - part_of_way(dot(to, way), dot(way, way)) * way;
  if (off.z <= 0.0) {
    const double far = norm(off);
    out = {far - radius, far > 0.0 ? off / far : Vec3{0.0, 0.0, -1.0}};
    return true;
  }
  const double level2 = way.x * way.x + way.y * way.y;
  Vec3 beside = to - part_of_way(to.x * way.x + to.y * way.y, level2) * way;
  if (!(beside.z >= 0.0)) return false;
  beside.z = 0.0;
  const double far = norm(beside);
  out = {far - radius, far > 0.0 ? beside / far : Vec3{1.0, 0.0, 0.0}};
  return true;
}

}  // namespace

// The distance is convex along the way: a bracket of slopes shrinks to the least. Tangents at both
// ends bound it from below.
SweepDistance distance_from(const CutterShape& cutter, const Sweep& sweep, Vec3 p) {
  SweepDistance ball;
  if (cutter.flat() <= 0.0 && distance_from_ball(cutter.radius, sweep, p, ball)) return ball;
  const Vec3 way = sweep.to - sweep.from;
  AtPlace low = at_place(cutter, sweep, way, 0.0, p);
  if (low.slope >= 0.0) return {low.value, low.gradient};
  AtPlace high = at_place(cutter, sweep, way, 1.0, p);
  if (high.slope <= 0.0) return {high.value, high.gradient};
  double from = 0.0, to = 1.0;
  const double settled = kSettledOnWay * cutter.radius;
  for (int step = 0; step < kMostWaySteps; ++step) {
    const double meet =
        (high.value - low.value + low.slope * from - high.slope * to) / (low.slope - high.slope);
    const double floor = low.value + low.slope * (meet - from);
    const AtPlace& best = low.value < high.value ? low : high;
    if (best.value - floor <= settled) return {best.value, best.gradient};
    double s = meet;  // kinks are met by the tangents, round places by the secant of the slopes
    if (step % 3 == 1) s = 0.5 * (from + to);
    if (step % 3 == 2) {
      const double inside = kSecantInside * (to - from);
      s = std::clamp(from - low.slope * (to - from) / (high.slope - low.slope), from + inside,
                     to - inside);
    }
    if (!(s > from && s < to)) return {best.value, best.gradient};
    const AtPlace at = at_place(cutter, sweep, way, s, p);
    (at.slope <= 0.0 ? from : to) = s;
    (at.slope <= 0.0 ? low : high) = at;
  }
  const AtPlace& best = low.value < high.value ? low : high;
  return {best.value, best.gradient};
}

// Newton's method comes from outside and never leaps over the entry: the distance is convex.
SweepEntry entry_into(const CutterShape& cutter, const Sweep& sweep, Vec3 from, Vec3 direction,
                      double most) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  double height = 0.0;
  for (int step = 0; step < kMostRaySteps; ++step) {
    const SweepDistance d = distance_from(cutter, sweep, from + height * direction);
    if (d.value <= kSettledOnWay * cutter.radius) return {height, d.gradient};
    const double nearer = -dot(d.gradient, direction);
    if (!(nearer > 0.0)) return {kNever, d.gradient};
    height += d.value / nearer;
    if (!(height <= most)) return {kNever, d.gradient};
  }
  return {kNever, {}};  // it grazes the body
}

// In the plane of the height h and the place s on the way the body is where the ray lies within the
// radius of the axis, a conic, and over the disc, a half plane: the least height lies at an end of
// the way, where the conic is lowest, or where both borders meet. Every place that is tried is one
// of the ray in the body, so the height is never too low.
double height_into_sharp(const CutterShape& cutter, const Sweep& sweep, Vec3 from, Vec3 direction,
                         double most) {
  const Vec3 way = sweep.to - sweep.from;
  const Vec2 a{from.x - sweep.from.x, from.y - sweep.from.y}, w{way.x, way.y},
      n{direction.x, direction.y};
  const double r2 = cutter.radius * cutter.radius, n2 = dot(n, n), w2 = dot(w, w);
  const double first = (sweep.from.z - from.z) / direction.z, more = way.z / direction.z;
  double best = std::numeric_limits<double>::infinity();
  const auto look = [&](double place) {
    const double s = std::clamp(place, 0.0, 1.0);
    const Vec2 b = a - s * w;
    const double out = dot(b, b) - r2, towards = dot(b, n);
    double height = std::max(0.0, first + s * more);
    if (n2 > 0.0) {
      const double root2 = towards * towards - n2 * out;
      if (!(root2 >= 0.0)) return;
      const double root = std::sqrt(root2);
      height = std::max(height, (-towards - root) / n2);
      if (height > (-towards + root) / n2) return;
    } else if (out > 0.0) {
      return;
    }
    best = std::min(best, height);
  };
  look(0.0);
  look(1.0);
  if (more != 0.0) look(-first / more);
  if (w2 > 0.0) {
    const double length = std::sqrt(w2), beside = cross(w, a) / length,
                 turns = cross(w, n) / length;
    look(dot(a, w) / w2);
    for (const double side : {-cutter.radius, cutter.radius}) {
      const double h = turns != 0.0 ? (side - beside) / turns : 0.0;
      if (h > 0.0) look(dot(a + h * n, w) / w2);
    }
  }
  const Vec2 c = a + first * n, d = more * n - w;
  const double d2 = dot(d, d), half = dot(c, d), root2 = half * half - d2 * (dot(c, c) - r2);
  if (d2 > 0.0 && root2 >= 0.0) {
    // a hair inside of the border, where rounding does not lose the place
    const double root = kInsideRim * std::sqrt(root2);
    look((-half - root) / d2);
    look((-half + root) / d2);
  }
  return best <= most ? best : std::numeric_limits<double>::infinity();
}

double distance_at_least(const CutterShape& cutter, const Sweep& sweep, Vec3 p, double enough) {
  const Vec3 way = sweep.to - sweep.from, to = p - sweep.from;
  const double length2 = way.x * way.x + way.y * way.y;
  const double along = to.x * way.x + to.y * way.y;
  const double s = part_of_way(along, length2);
  const double dx = to.x - s * way.x, dy = to.y - s * way.y;
  const double above = std::min(sweep.from.z, sweep.to.z) - p.z;
  const double far = cutter.radius + enough;
  if (above > enough || (far > 0.0 && dx * dx + dy * dy > far * far)) {
    return std::max(above, std::sqrt(dx * dx + dy * dy) - cutter.radius);
  }
  const AtPlace middle = at_place(cutter, sweep, way, 0.5, p);
  return middle.value - 0.5 * std::abs(middle.slope);
}

}  // namespace obvid::toolpath
